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
from node_process import PATIENCE, wait_for_topic, wait_until  # noqa: E402


def answer_to(goal):
    """Final status and result of a goal. A SimpleActionClient drops an answer that comes before it has kept its own handle, and then waits for ever."""
    client = actionlib.ActionClient("optimize", OptimizeAction)
    assert client.wait_for_server(rospy.Duration(PATIENCE)), "no action"
    wait_for_topic("/optimization", client.result_sub)
    handle = client.send_goal(goal)
    wait_until(lambda: handle.get_comm_state() == actionlib.CommState.DONE, "a goal has no answer")
    return handle.get_goal_status(), handle.get_result()


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

        status, refused = answer_to(OptimizeGoal())
        self.assertEqual((status, refused.code), (GoalStatus.REJECTED, "busy"))

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
