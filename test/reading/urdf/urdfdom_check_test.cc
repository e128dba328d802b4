// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include <console_bridge/console.h>

#include <thread>

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(UrdfdomCheck, WhatItOnlyGrumblesAboutIsRead) {
  EXPECT_NO_THROW(read_urdf(robot_text("<link name=\"a\"><visual/></link><material name=\"\"/>")));
}

TEST(UrdfdomCheck, LeavesTheOutputHandlerAsItWas) {
  console_bridge::OutputHandler* before = console_bridge::getOutputHandler();
  EXPECT_NO_THROW(
      check_with_urdfdom(XmlDocument({"a", "<robot name=\"x\"><link name=\"a\"/></robot>"})));
  EXPECT_THROW(check_with_urdfdom(XmlDocument({"a", "<robot/>"})), InputError);
  EXPECT_EQ(console_bridge::getOutputHandler(), before);
}

TEST(UrdfdomCheck, ThreadsKeepTheirMessagesApart) {
  std::vector<std::string> messages(4);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < messages.size(); ++k) {
    threads.emplace_back([&messages, k] {
      const std::string name = "link_" + std::to_string(k);
      try {
        check_with_urdfdom(XmlDocument({"a", "<robot name=\"x\"><link name=\"" + name +
                                                 "\"/>\n<link name=\"" + name + "\"/></robot>"}));
      } catch (const InputError& error) {
        messages[k] = error.what();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < messages.size(); ++k) {
    EXPECT_EQ(messages[k].substr(0, 4), "a:2:") << "the second link of this name";
    for (std::size_t other = 0; other < messages.size(); ++other)
      EXPECT_EQ(messages[k].find("link_" + std::to_string(other)) != std::string::npos, other == k)
          << messages[k];
  }
}

}  // namespace
}  // namespace codesign
