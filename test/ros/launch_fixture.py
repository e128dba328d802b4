# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Launch files as users call them, on a master whose parameters they must leave as they found them."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile

import rospy
import yaml
from mechanism_codesign.srv import OptimizeRequest
from node_process import Launch, NodesTestCase, wait_until

FOUND = {"/use_sim_time": False, "/robot_description": "what was here", "/simulation/rate": 7, "/replay/color": [1, 2], "/rviz/a": {"b": 1.5},
         "/tuned/robot_description": "the tuned one", "/optimization/set/crank_length": 0.07}
FAST = ("simulate.launch", "rviz:=false", "mode:=as_fast_as_possible", "loop:=true")
REAL_TIME = ("simulate.launch", "rviz:=false", "set:={crank_length: 0.09}", "loop:=true")


def parameters():
    """All parameters of the master except those that roslaunch itself leaves there."""
    return {name: rospy.get_param(name) for name in rospy.get_param_names() if not name.startswith("/roslaunch/")}


def records():
    return [name for name in rospy.get_param_names() if name.endswith("/before_launch")]


def processes(parent=None):
    """Numbers and command lines."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if parent is None or int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1]) == parent:
                found.append((int(folder.name), (folder / "cmdline").read_text()))
        except (OSError, ValueError):
            continue
    return found


def nodes_of(launch):
    return [pid for pid, _ in processes(launch.process.pid)]


def orphans():
    """Nodes of launch files on this master whose roslaunch is gone. A roslaunch that is interrupted just as it starts a node forgets that node, which then
    computes for ever, at the cost of all tests that follow."""
    found = []
    for pid, words in processes(parent=1):
        try:
            environment = pathlib.Path(f"/proc/{pid}/environ").read_text().split("\0")
        except OSError:
            continue
        if "__name:=" in words and f"ROS_MASTER_URI={os.environ['ROS_MASTER_URI']}" in environment:
            found.append(pid)
    return found


class LaunchTestCase(NodesTestCase):
    recorded = None  # the bag of an optimization, made once

    @classmethod
    def tearDownClass(cls):
        if LaunchTestCase.recorded:
            os.remove(LaunchTestCase.recorded)

    def setUp(self):
        super().setUp()
        self.launches = []
        for name in parameters():
            if not name.startswith(("/ros", "/run_id")):
                rospy.delete_param(name)
        for name, value in FOUND.items():
            rospy.set_param(name, value)
        self.before = parameters()

    def tearDown(self):
        for launch in self.launches:
            launch.end()
        for pid in orphans():
            os.kill(pid, signal.SIGKILL)
        wait_until(lambda: not orphans(), "a node does not end")
        super().tearDown()

    def launch(self, *arguments, **settings):
        """Returns once all parameters are set."""
        earlier = set(records())
        launch = Launch(*arguments, **settings)
        self.launches.append(launch)
        wait_until(lambda: set(records()) - earlier or launch.process.poll() is not None, f"{arguments} sets nothing")
        wait_until(lambda: nodes_of(launch) or launch.process.poll() is not None, f"{arguments} starts nothing")
        self.assertIsNone(launch.process.poll(), launch.output() if launch.process.poll() is not None else "")
        return launch

    def end(self, *launches):
        """Ends launch files. Parameters that the node had no time to restore are restored by its background process a moment later."""
        count = len(records())
        for launch in launches:
            launch.process.send_signal(signal.SIGINT)
        for launch in launches:
            launch.end()
        wait_until(lambda: len(records()) == count - len(launches), "nobody restores the parameters")

    def bag(self):
        if not LaunchTestCase.recorded:
            node = self.start("optimization", "recorded", output_directory=self.folder)
            reply = node.optimize(OptimizeRequest(max_evaluations=1))
            node.end()
            LaunchTestCase.recorded = tempfile.mktemp(suffix=".bag")
            shutil.move(reply.bag, LaunchTestCase.recorded)
        return LaunchTestCase.recorded

    def replay(self, bag):
        return self.launch("replay.launch", "rviz:=false", f"bag:={bag}")

    def set_by(self, *arguments, home):
        """What a launch file would set. In the folder of the test."""
        command = ["roslaunch", "--dump-params", "mechanism_codesign", *arguments]
        reply = subprocess.run(command, cwd=self.folder, env={**os.environ, "HOME": home}, stdout=subprocess.PIPE, text=True, check=True)
        return yaml.safe_load(reply.stdout)

    def assert_left_as_found(self):
        self.assertEqual(parameters(), self.before)
