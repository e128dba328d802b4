#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""While a job runs, other services answer, a second job is refused, and a cancelled job returns its best point."""
import os
import shutil
import sys
import threading
import unittest

import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from mechanism_codesign.msg import OptimizeAction, OptimizeGoal
from mechanism_codesign.srv import Evaluate, EvaluateRequest, Optimize, OptimizeRequest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE, wait_until  # noqa: E402


class BusyTest(unittest.TestCase):
    def tearDown(self):
        shutil.rmtree(rospy.get_param("optimization/output_directory"), ignore_errors=True)

    def test_doors_while_a_job_runs(self):
        client = actionlib.SimpleActionClient("optimize", OptimizeAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(PATIENCE)))
        under_way = threading.Event()
        client.send_goal(OptimizeGoal(relative_tolerance=1e-15, max_evaluations=100000), feedback_cb=lambda feedback: under_way.set())
        self.assertTrue(under_way.wait(PATIENCE))

        second = rospy.ServiceProxy("optimize", Optimize)(OptimizeRequest())
        self.assertFalse(second.success)
        self.assertEqual(second.code, "busy")

        other = actionlib.SimpleActionClient("optimize", OptimizeAction)
        other.wait_for_server(rospy.Duration(PATIENCE))
        # The Python client of actions may miss an answer that comes at once.
        wait_until(lambda: other.send_goal_and_wait(OptimizeGoal(), rospy.Duration(PATIENCE / 10)) == GoalStatus.REJECTED, "a second goal is not rejected")
        self.assertEqual(other.get_result().code, "busy")

        evaluation = rospy.ServiceProxy("evaluate", Evaluate)(EvaluateRequest(objective_only=True))
        self.assertTrue(evaluation.success, evaluation.message)
        self.assertEqual(client.get_state(), GoalStatus.ACTIVE)

        client.cancel_goal()
        self.assertTrue(client.wait_for_result(rospy.Duration(PATIENCE)))
        self.assertEqual(client.get_state(), GoalStatus.PREEMPTED)
        result = client.get_result()
        self.assertEqual(result.code, "cancelled")
        self.assertEqual(sorted(result.parameters), ["Kp", "crank_length", "rod_length", "slider_length"])
        self.assertLessEqual(result.objective, result.initial_objective)
        self.assertNotEqual(result.bag, "")


if __name__ == "__main__":
    rospy.init_node("busy_test")
    rostest.rosrun("mechanism_codesign", "busy", BusyTest)
