// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/mesh_reader.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "math/arrays.h"
#include "reading/urdf/pictures.h"
#include "text/number_text.h"

namespace codesign {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 256U << 20U;
constexpr double kMostHoles = 0.01;  // of the surface
constexpr const char* kAllowed =
    "a closed surface in STL or OBJ, <box>, <cylinder>, <sphere>, or codesign:from with the other "
    "kind of shapes";

/// A binary STL: 80 bytes, the number of triangles, and of each its normal, corners and two bytes.
std::vector<Triangle> binary_triangles(const std::string& content) {
  constexpr std::size_t kHead = 84, kEach = 50;
  std::vector<Triangle> triangles;
  if (content.size() < kHead) return triangles;
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + 80, sizeof count);
  if (content.size() < kHead + kEach * std::size_t{count}) return triangles;
  triangles.resize(count);
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    std::array<float, 9> x{};
    std::memcpy(x.data(), content.data() + kHead + kEach * k + 12, sizeof x);
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t i = 0; i < 3; ++i)
        triangles[k][corner][to_signed(i)] = static_cast<double>(x[3 * corner + i]);
  }
  return triangles;
}

/// An STL as text: the words `vertex x y z`, three per triangle.
std::vector<Triangle> text_triangles(const std::string& content) {
  std::vector<Triangle> triangles;
  std::istringstream words(content);
  std::size_t corner = 0;
  for (std::string word; words >> word;) {
    if (word != "vertex") continue;
    if (corner == 0) triangles.emplace_back();
    Eigen::Vector3d& x = triangles.back()[corner];
    if (!(words >> x[0] >> x[1] >> x[2])) return {};
    corner = (corner + 1) % 3;
  }
  return corner == 0 ? triangles : std::vector<Triangle>();
}

/// An OBJ: `v x y z`, and `f 1/2/3 ...` whose first numbers are indices from 1, or from the end if
/// negative. Polygons are fans of triangles.
std::vector<Triangle> obj_triangles(const std::string& content) {
  std::vector<Triangle> triangles;
  std::vector<Eigen::Vector3d> corners;
  std::istringstream lines(content);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Eigen::Vector3d x;
      if (!(words >> x[0] >> x[1] >> x[2])) return {};
      corners.push_back(x);
    } else if (word == "f") {
      std::vector<Eigen::Vector3d> polygon;
      for (std::string of; words >> of;) {
        const long index = std::strtol(of.c_str(), nullptr, 10);
        const long place = index > 0 ? index - 1 : static_cast<long>(corners.size()) + index;
        if (place < 0 || place >= static_cast<long>(corners.size())) return {};
        polygon.push_back(corners[static_cast<std::size_t>(place)]);
      }
      for (std::size_t k = 2; k < polygon.size(); ++k)
        triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
    }
  }
  return triangles;
}

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string content_of(const fs::path& path, const XmlElement& mesh) {
  std::error_code ignored;
  if (fs::file_size(path, ignored) > kMostBytes || ignored)
    mesh.fail_at("filename", "the file of the mesh has more than 256 MB", "a smaller file");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  if (!file) mesh.fail_at("filename", "the file of the mesh cannot be read", path.string());
  return content.str();
}

}  // namespace

std::vector<Triangle> triangles_in(const std::string& content, bool is_obj) {
  if (is_obj) return obj_triangles(content);
  // Some programs begin binary files with the word of those as text, too.
  std::vector<Triangle> triangles = binary_triangles(content);
  if (triangles.empty()) triangles = text_triangles(content);
  const auto is_finite = [](const Triangle& one) {
    return one[0].allFinite() && one[1].allFinite() && one[2].allFinite();
  };
  if (!std::all_of(triangles.begin(), triangles.end(), is_finite)) triangles.clear();
  return triangles;
}

MeshMoments read_mesh(const XmlElement& mesh) {
  const std::string uri = mesh.text("filename");
  const fs::path path = MeshFinder().find(uri, mesh.where().file);
  if (path.empty())
    mesh.fail_at("filename",
                 "mass is to be computed from this mesh, but its file is not here: packages are "
                 "looked for in ROS_PACKAGE_PATH and above the model, other paths beside it",
                 kAllowed);
  const std::string extension = lower_extension(path);
  if (extension != ".stl" && extension != ".obj")
    mesh.fail_at("filename", "mass cannot be computed from meshes of this format", kAllowed);
  const std::vector<Triangle> triangles = triangles_in(content_of(path, mesh), extension == ".obj");
  if (triangles.empty())
    mesh.fail_at("filename", "the file of the mesh has no triangles that can be read", kAllowed);
  MeshMoments moments = moments_of(triangles);
  if (moments.holes > kMostHoles || !(moments.volume > 0.0))
    mesh.fail_at("filename",
                 "the mesh is no closed surface, so that it has no volume: its holes have " +
                     readable(100.0 * moments.holes, 2) + " % of its area",
                 kAllowed);
  return moments;
}

}  // namespace codesign
