// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/run_node.h"

#include <gtest/gtest.h>
#include <ros/xmlrpc_manager.h>

#include <csignal>

namespace codesign {
namespace {

/// Puts the handlers of the test program back.
class EndRequest : public testing::Test {
 protected:
  EndRequest()
      : interrupt_(std::signal(SIGINT, SIG_DFL)),
        terminate_(std::signal(SIGTERM, SIG_DFL)),
        hang_up_(std::signal(SIGHUP, SIG_DFL)) {}
  ~EndRequest() override {
    std::signal(SIGINT, interrupt_);
    std::signal(SIGTERM, terminate_);
    std::signal(SIGHUP, hang_up_);
    ros::XMLRPCManager::instance()->unbind("shutdown");
  }

 private:
  void (*interrupt_)(int);
  void (*terminate_)(int);
  void (*hang_up_)(int);
};

volatile std::sig_atomic_t end_requests = 0;

TEST_F(EndRequest, EverySignalThatEndsIsPassedOn) {
  on_end_request([] { end_requests = end_requests + 1; });
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const int before = end_requests;
    std::raise(signal);
    EXPECT_EQ(end_requests, before + 1) << signal;
  }
}

TEST_F(EndRequest, ComesBeforeTheAnswerOfRosToAShutdown) {
  on_end_request([] {});
  EXPECT_FALSE(ros::XMLRPCManager::instance()->bind(
      "shutdown", [](XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue&) {}));
}

TEST_F(EndRequest, AnIgnoredHangUpStaysIgnored) {
  std::signal(SIGHUP, SIG_IGN);
  on_end_request([] {});
  EXPECT_EQ(std::signal(SIGHUP, SIG_DFL), SIG_IGN);
}

}  // namespace
}  // namespace codesign
