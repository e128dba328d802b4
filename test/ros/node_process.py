# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Nodes as processes of a test, which ends them by signals as users do."""
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import xmlrpc.client

import rosgraph
import roslib.packages
import rospkg
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from mechanism_codesign.srv import Evaluate, Optimize

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
from patience import PATIENCE, wait_until  # noqa: E402,F401

SHARE = rospkg.RosPack().get_path("mechanism_codesign")


def program_path(name):
    """Of one of our programs or scripts. find_node walks through the package's folder, and a build there that is not done stops it."""
    folders = [os.path.join(prefix, "lib", "mechanism_codesign") for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)]
    found = [path for path in (os.path.join(folder, name) for folder in [*folders, os.path.join(SHARE, "scripts")]) if os.access(path, os.X_OK)]
    return found[0] if found else roslib.packages.find_node("mechanism_codesign", name)[0]


class Node:
    """One node with its own name and the given parameters. `model`: a shipped case, or the path of a URDF. `prefix`: the words of a launch-prefix."""

    def __init__(self, program, name, model="slider_crank", prefix=(), **parameters):
        self.name = name
        path = model if model.endswith(".urdf") else f"{SHARE}/urdf/{model}.urdf"
        for key, value in {"model": path, "study": f"{SHARE}/config/{model}.yaml", **parameters}.items():
            if value is not None:
                rospy.set_param(f"/{name}/{key}", value)
        self.log = tempfile.TemporaryFile("w+")
        remappings = [f"{topic}:=/{name}/{topic}" for topic in
                      ("optimize", "evaluate", "identify", "apply", "optimization_progress", "identification_progress", "identified/robot_description")]
        path = program_path(program)
        self.process = subprocess.Popen([*prefix, path, f"__name:={name}", *remappings], stdout=self.log, stderr=subprocess.STDOUT)

    def optimize(self, request):
        rospy.wait_for_service(f"/{self.name}/optimize", PATIENCE)
        return rospy.ServiceProxy(f"/{self.name}/optimize", Optimize)(request)

    def evaluate(self, request):
        rospy.wait_for_service(f"/{self.name}/evaluate", PATIENCE)
        return rospy.ServiceProxy(f"/{self.name}/evaluate", Evaluate)(request)

    def end(self, kind=signal.SIGINT):
        """Sends the signal and returns once the node has ended."""
        if self.process.poll() is None:
            self.process.send_signal(kind)
        try:
            self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        if rospy.has_param(f"/{self.name}"):
            rospy.delete_param(f"/{self.name}")

    def output(self):
        self.log.seek(0)
        return self.log.read()


class Launch:
    """A launch file of the package."""

    def __init__(self, file, *arguments, cwd=None, environment=None):
        self.log = tempfile.TemporaryFile("w+")
        command = ["roslaunch", "mechanism_codesign", file, *arguments]
        self.process = subprocess.Popen(command, cwd=cwd, env={**os.environ, **(environment or {})}, stdout=self.log, stderr=subprocess.STDOUT)

    def end(self, kind=signal.SIGINT):
        """Repeats the signal, since roslaunch may miss one while it starts. In a test that fails, what was printed tells why."""
        fails = sys.exc_info()[0] is not None
        for _ in range(6):
            if self.process.poll() is None:
                self.process.send_signal(kind)
            try:
                status = self.process.wait(PATIENCE / 6)
            except subprocess.TimeoutExpired:
                continue
            if fails:
                print(self.output(), file=sys.stderr)
            return status
        raise AssertionError("roslaunch does not end")

    def output(self):
        self.process.wait(PATIENCE)
        self.log.seek(0)
        return self.log.read()


def state_of(name, wanted):
    """The first state of a node on /diagnostics whose sentence matches."""
    found, done = [], threading.Event()

    def receive(message):
        for status in message.status:
            if status.name.startswith(name + ":") and re.search(wanted, status.message):
                found.append(status)
                done.set()

    subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, receive)
    assert done.wait(PATIENCE), f"{name} never says {wanted}"
    subscriber.unregister()
    return found[0]


def study_of(seconds, folder=None):
    """The study of the slider-crank with runs of so many seconds instead of 2."""
    with open(f"{SHARE}/config/slider_crank.yaml", encoding="utf-8") as file:
        text = file.read()
    assert text.count("duration: 2.0") == 1
    path = tempfile.mktemp(suffix=".yaml", dir=folder)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace("duration: 2.0", f"duration: {seconds}"))
    return path


def content(message):
    """All but the number that each topic gives to its messages."""
    message.header.seq = 0
    return str(message)


def values_of(status):
    return {value.key: value.value for value in status.values}


class NodesTestCase(unittest.TestCase):
    """A test with its own folder; its nodes are ended with it."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.nodes = []

    def tearDown(self):
        for node in self.nodes:
            if node.process.poll() is None:
                node.end(signal.SIGKILL)
        shutil.rmtree(self.folder, ignore_errors=True)

    def start(self, program, name, **parameters):
        node = Node(program, name, **parameters)
        self.nodes.append(node)
        return node


def listeners(node, topic):
    """The names of the nodes that a node sends a topic to. The master and the listener count one earlier, when it still misses messages."""
    master = rosgraph.Master(rospy.get_name())
    _, _, connections = xmlrpc.client.ServerProxy(master.lookupNode(node)).getBusInfo(rospy.get_name())
    return {listener for _, listener, direction, _, sent, *_ in connections if (direction, sent) == ("o", topic)}


def wait_for_topic(node, topic):
    """Until a node sends a topic, a rospy.Subscriber, to this one."""
    wait_until(lambda: topic.get_num_connections() > 0 and rospy.get_name() in listeners(node, topic.resolved_name),
               f"{node} does not publish {topic.resolved_name}")


def files(folder, ending):
    return sorted(os.path.join(folder, name) for name in os.listdir(folder) if name.endswith(ending))
