// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/record_schema.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <utility>

#include "jobs/result_fields.h"
#include "paths.h"

namespace codesign {

/// A result with a field of each kind.
struct DescribedPart {
  int line = 0;
};
struct DescribedSample {
  std::string name, note;
  double value = 0.0, weight = 0.0;
  bool failed = false, rises = false;
  std::optional<double> limit;
  std::vector<std::string> words;
  std::vector<DescribedPart> parts;
};
constexpr auto fields_of(const DescribedPart*) {
  return std::make_tuple(field("line", &DescribedPart::line, "from 1"));
}
constexpr auto fields_of(const DescribedSample*) {
  using S = DescribedSample;
  return std::make_tuple(
      field("name", &S::name, "n"), field("value", &S::value, "v"),
      field("weight", &S::weight, "w").finite(), field("failed", &S::failed, "f").not_always(),
      word("direction", &S::rises, "falling", "rising", "d"), field("limit", &S::limit, "l"),
      field("words", &S::words, "ws"), field("parts", &S::parts, "p"),
      field(
          "note", [](const S& one) { return unless_empty(one.note); }, "o"),
      field(
          "interval",
          [](const S& one) {
            return std::array<double, 2>{one.value, one.weight};
          },
          "i"));
}

namespace {

TEST(RecordSchema, FollowsFromTypesAndRows) {
  EXPECT_EQ(record_schema<DescribedSample>(), Json::parse(R"({
    "type": "object",
    "properties": {
      "name": {"type": "string", "description": "n"},
      "value": {"type": ["number", "null"], "description": "v"},
      "weight": {"type": "number", "description": "w"},
      "failed": {"type": "boolean", "description": "f"},
      "direction": {"enum": ["rising", "falling"], "description": "d"},
      "limit": {"type": ["number", "null"], "description": "l"},
      "words": {"type": "array", "items": {"type": "string"}, "description": "ws"},
      "parts": {"type": "array", "items": {"type": "object", "properties":
        {"line": {"type": "integer", "description": "from 1"}},
        "additionalProperties": false, "required": ["line"]}, "description": "p"},
      "note": {"type": "string", "description": "o"},
      "interval": {"type": "array", "items": {"type": ["number", "null"]}, "description": "i"}},
    "additionalProperties": false,
    "required": ["name", "value", "weight", "direction", "words", "parts", "interval"]})"));
}

/// The results that documents have, by the names that doc/schema/documents.json gives them.
const std::map<std::string, Json>& schemas() {
  static const std::map<std::string, Json> kSchemas{
      {"before_after", record_schema<BeforeAfter>()},
      {"choice", record_schema<ChoiceResult>()},
      {"combination", record_schema<BaseParameter>()},
      {"compared", record_schema<ComparedTrajectory>()},
      {"comparison", record_schema<ModelComparison>()},
      {"counts", record_schema<Counts>()},
      {"differences", record_schema<IndependentCheck>()},
      {"event", record_schema<Event>()},
      {"excitation", record_schema<ExcitationResult>()},
      {"excitation_start", record_schema<ExcitationStart>()},
      {"identification", record_schema<IdentificationResult>()},
      {"identified", record_schema<IdentifiedNumber>()},
      {"judged_pair", record_schema<JudgedPair>()},
      {"kept_limit", record_schema<KeptLimit>()},
      {"largest", record_schema<Extreme>()},
      {"limit", record_schema<LimitCrossing>()},
      {"machine_number", record_schema<MachineNumber>()},
      {"margin", record_schema<AtFrequency>()},
      {"method_change", record_schema<MethodChange>()},
      {"mode", record_schema<LinearMode>()},
      {"multistart", record_schema<MultistartResult>()},
      {"near_links", record_schema<NearLinks>()},
      {"optimum", record_schema<Optimum>()},
      {"output_fit", record_schema<OutputFit>()},
      {"predicted", record_schema<PredictedNumber>()},
      {"recording", record_schema<RecordingSummary>()},
      {"scenario", record_schema<ScenarioResult>()},
      {"search_cost", record_schema<SearchCost>()},
      {"state_space", record_schema<StateSpace>()},
      {"statistics", record_schema<Statistics>()},
      {"status", record_schema<Status>()},
      {"tradeoff", record_schema<TradeoffResult>()},
      {"tradeoff_point", record_schema<TradeoffPoint>()},
      {"uncertainty", record_schema<Uncertainty>()},
      {"validation", record_schema<Validation>()},
      {"verification", record_schema<GradientCheck>()},
      {"warning", record_schema<Warning>()},
      {"watched", record_schema<WatchedResult>()},
      {"whiteness", record_schema<Whiteness>()}};
  return kSchemas;
}

/// doc/schema/documents.json with the rows of results and its own groups of keys in their places.
/// `"<statistics>": "always"` stands for such rows, "sometimes" if a document may be without them.
class Documents {
 public:
  explicit Documents(Json json) : json_(std::move(json)) {}

  Json schema() const {
    Json schema = filled(json_);
    schema.erase("groups");
    return schema;
  }

 private:
  Json rows_of(const std::string& marker) const {
    const std::string name = marker.substr(1, marker.size() - 2);
    if (json_["groups"].contains(name)) return filled(json_["groups"][name]);
    const Json& rows = schemas().at(name);
    for (const auto& [key, row] : rows["properties"].items())
      EXPECT_NE(row.at("description"), "") << name << ": " << key;
    return rows;
  }

  void add_rows(const std::string& marker, const Json& how, Json* object) const {
    const Json rows = rows_of(marker);
    for (const auto& [key, row] : rows["properties"].items()) (*object)["properties"][key] = row;
    if (how == "always")
      for (const Json& key : rows["required"]) (*object)["required"].push_back(key);
    else
      EXPECT_EQ(how, "sometimes") << marker;
  }

  /// What an object itself says of a key of its rows replaces all but the meaning.
  void add_own(const std::string& key, const Json& value, Json* object) const {
    Json& property = (*object)["properties"][key];
    const Json known = property;
    property = value;
    if (known.is_object()) property["description"] = known["description"];
  }

  Json filled(const Json& part) const {
    Json result = part;
    if (!part.is_structured()) return result;
    for (auto& [key, value] : result.items()) value = filled(value);
    if (!part.is_object() || !part.contains("properties")) return result;
    const Json own = std::exchange(result["properties"], Json::object());
    for (const auto& [key, value] : own.items())
      value.is_string() ? add_rows(key, value, &result) : add_own(key, value, &result);
    return result;
  }

  const Json json_;
};

Json read_json(const std::string& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

// documents.json says what each command prints; the schema follows from it and from the rows. With
// CODESIGN_WRITE_SCHEMA in the environment it is written.
TEST(RecordSchema, OfTheDocumentsIsMadeFromTheRows) {
  const std::string folder = source_dir() + "/doc/schema/", path = folder + "codesign.schema.json";
  const Json schema = Documents(read_json(folder + "documents.json")).schema();
  if (std::getenv("CODESIGN_WRITE_SCHEMA") != nullptr)
    std::ofstream(path) << schema.dump(1) << '\n';
  EXPECT_EQ(schema.dump(), read_json(path).dump()) << "run tools/json_page --write";
}

}  // namespace
}  // namespace codesign
