#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Parameters of a running simulation, changed by the client of dynamic_reconfigure, which the project has not written."""
import math
import os
import sys
import tempfile
import threading
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.msg import Config, DoubleParameter
from dynamic_reconfigure.srv import Reconfigure
from mechanism_codesign.msg import LoopErrors
from std_msgs.msg import String
from std_srvs.srv import Trigger

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from node_process import PATIENCE, SHARE, Node, state_of, values_of, wait_for_topic, wait_until  # noqa: E402
from robot_node import Latest, Robot  # noqa: E402

NAME = "/robot/simulation"


class LiveParametersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(paused=True)
        cls.loops = Latest("/robot/loop_errors", LoopErrors)
        cls.descriptions = Latest("/robot/robot_description", String)
        cls.updates = []
        cls.client = Client(NAME, timeout=PATIENCE, config_callback=cls.updates.append)
        cls.initial = dict(cls.client.get_configuration(PATIENCE))
        wait_for_topic(NAME, cls.loops.subscriber)
        for _ in range(10):
            cls.robot.step()

    def setUp(self):
        names = ("crank_length", "rod_length", "slider_length", "slider_width", "Kp")
        self.client.update_configuration({name: self.initial[name] for name in names})
        # Behind a step there are no more messages about the change.
        self.robot.step()
        self.robot.controller_states()

    def test_every_parameter_has_its_bounds(self):
        described = {each["name"]: each for each in self.client.get_parameter_descriptions(PATIENCE)}
        self.assertEqual(set(described), {"crank_length", "rod_length", "slider_length", "slider_width", "Kp"})
        crank, gain = described["crank_length"], described["Kp"]
        self.assertEqual((crank["type"], crank["min"], crank["max"], crank["default"]), ("double", 0.06, 0.1, 0.08))
        self.assertEqual((gain["min"], gain["max"], gain["default"]), (-5.0, 5.0, 1.0))
        self.assertEqual(self.initial["crank_length"], 0.08)

    def test_a_gain_acts_at_once_and_moves_nothing(self):
        before, output = self.robot.joints.last(), self.robot.controller_states()
        answer = self.client.update_configuration({"Kp": 4.0})
        self.assertEqual(answer["Kp"], 4.0)
        wait_until(lambda: self.robot.controllers.last() is not output, "the new gain is not shown")
        behind = self.robot.controllers.last()
        self.assertAlmostEqual(behind.output[0], 4.0 * output.output[0], delta=1e-6)
        # The run goes on from its dense output, projected onto the constraints.
        self.assertAlmostEqual(behind.input[0], output.input[0], delta=1e-7)
        for moved, still in zip(self.robot.joints.last().position, before.position):
            self.assertAlmostEqual(moved, still, delta=1e-9)
        wait_until(lambda: self.updates and self.updates[-1]["Kp"] == 4.0, "parameter_updates")

    def test_a_dimension_changes_with_the_crank_where_it_is_and_the_loop_closed(self):
        before = self.robot.joints.last()
        crank, slider = before.name.index("crank_joint"), before.name.index("slider_joint")
        answer = self.client.update_configuration({"crank_length": 0.095})
        self.assertEqual(answer["crank_length"], 0.095)
        wait_until(lambda: self.robot.joints.last().position[slider] != before.position[slider], "the new dimension is not shown")
        behind = self.robot.joints.last()
        self.assertAlmostEqual(behind.position[crank], before.position[crank], delta=1e-9)
        self.assertAlmostEqual(behind.velocity[crank], before.velocity[crank], delta=1e-7)
        wait_until(lambda: "0.095" in self.descriptions.last().data, "robot_description")
        after = self.robot.step()
        self.assertGreater(abs(after.position[crank] - behind.position[crank]), 0.01)
        wait_until(lambda: self.loops.messages and self.loops.last().header.stamp >= after.header.stamp, "no errors of loops")
        self.assertLess(max(self.loops.last().error), 1e-7)

    def test_a_value_beyond_its_bound_becomes_the_bound(self):
        self.assertEqual(self.client.update_configuration({"Kp": 99.0})["Kp"], 5.0)
        self.assertTrue(any("parameter_bounded" in key for key in values_of(state_of(NAME[1:], "warning"))))

    def test_a_number_that_is_not_finite_and_an_unknown_name_are_refused(self):
        service = rospy.ServiceProxy(NAME + "/set_parameters", Reconfigure)
        for name, value in (("Kp", math.nan), ("krank_length", 0.07)):
            answer = service(Config(doubles=[DoubleParameter(name, value)])).config
            values = {each.name: each.value for each in answer.doubles}
            self.assertEqual((values["Kp"], values["crank_length"]), (1.0, 0.08))
            self.assertNotIn("krank_length", values)
            self.assertTrue(any("parameter_refused" in key for key in values_of(state_of(NAME[1:], "warning"))))

    def test_requests_at_the_same_time_are_all_answered(self):
        service, answers = rospy.ServiceProxy(NAME + "/set_parameters", Reconfigure), []

        def change(k):
            answers.append(service(Config(doubles=[DoubleParameter("Kp", 0.1 * k), DoubleParameter("crank_length", 0.07 + 0.001 * k)])))

        threads = [threading.Thread(target=change, args=(k,)) for k in range(1, 9)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(PATIENCE)
        self.assertEqual(len(answers), 8)
        self.robot.step()

    def test_a_dimension_that_closes_no_loop_is_refused_and_the_run_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wide.urdf")
            with open(f"{SHARE}/urdf/slider_crank.urdf") as model, open(path, "w") as wide:
                text = model.read()
                self.assertEqual(text.count('lower="0.06" upper="0.1"'), 1)
                wide.write(text.replace('lower="0.06" upper="0.1"', 'lower="0.06" upper="0.9"'))
            node = Node("simulation", "wide", model=path, study=f"{SHARE}/config/slider_crank.yaml", rate=100.0, duration=1000.0,
                        mode="as_fast_as_possible", start_paused=True)
            try:
                client = Client("/wide", timeout=PATIENCE)
                step = rospy.ServiceProxy("/wide/step", Trigger)
                # The crank turns by some 0.1 rad in each; at 1 rad a rod of 0.3 m does not reach the slider from a crank of 0.9 m.
                for _ in range(10):
                    self.assertTrue(step().success)
                self.assertEqual(client.update_configuration({"crank_length": 0.9})["crank_length"], 0.08)
                told = [value for key, value in values_of(state_of("wide", "warning")).items() if "parameter_refused" in key]
                self.assertEqual(len(told), 1)
                self.assertIn("assembly_failed", told[0])
                self.assertTrue(step().success)
                self.assertEqual(client.update_configuration({"crank_length": 0.09})["crank_length"], 0.09)
                self.assertTrue(step().success)
            finally:
                node.end()

    def test_a_restart_keeps_the_values(self):
        self.client.update_configuration({"Kp": 3.0})
        self.assertTrue(self.robot.call("restart").success)
        wait_until(lambda: self.client.get_configuration(PATIENCE)["Kp"] == 3.0, "another value")
        self.robot.step()
        state = self.robot.controller_states()
        self.assertAlmostEqual(state.output[0], 3.0 * state.error[0], delta=1e-9)


if __name__ == "__main__":
    rospy.init_node("live_parameters_test")
    rostest.rosrun("mechanism_codesign", "live_parameters", LiveParametersTest)
