# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""The ROS side of the panel."""
import math
import re
import threading
import time
import uuid
import xmlrpc.client

from .board import number
from .requests import Refused

PATIENCE = 3.0  # [s] until a service or a listener must be known to the master
STANDS = "~step or ~resume"  # what a paused run waits for
AFTER_PAUSE = 2.5  # [s] after which diagnostics of a run that goes on are not from before the pause
LATENESS = 30.0  # [s] until one that is known must answer: its machine may be busy


def setpoint_topics(controllers):
    """The topic of each controller's set-point, from all controllers of a study in its order: the rule of the node `simulation`."""
    topics = {}
    for name in controllers:
        legal = re.sub(rb"[^A-Za-z0-9/]", b"_", name.encode()).decode()
        base = topic = legal if re.match("[A-Za-z/]", name) else "controller_" + legal
        number_behind = 1
        while topic + "/command" in topics.values():
            number_behind += 1
            topic = f"{base}_{number_behind}"
        topics[name] = topic + "/command"
    return topics


class Nodes:
    """The ROS side: topics of both nodes to the board, what the page asks for to the nodes."""

    def __init__(self, board, simulation, optimization):
        import rospy
        from actionlib_msgs.msg import GoalStatus, GoalStatusArray
        from diagnostic_msgs.msg import DiagnosticArray
        from dynamic_reconfigure import msg as reconfigure, srv as reconfigure_services
        from mechanism_codesign import msg
        from sensor_msgs.msg import JointState
        from std_msgs.msg import Float64
        from std_srvs.srv import Trigger
        self._ros, self._msg, self._reconfigure, self._float, self._joint_state = rospy, msg, reconfigure, Float64, JointState
        self._trigger, self._set_parameters, self._rejected = Trigger, reconfigure_services.Reconfigure, GoalStatus.REJECTED
        self._board, self._simulation, self._optimization = board, simulation, optimization
        self.forget_pauses()
        self._publishers, self._lock, self._controllers, self._goals, self._ended = {}, threading.Lock(), None, {}, None
        board.tell("simulation", name=rospy.resolve_name(simulation))
        board.tell("optimization", name=rospy.resolve_name(optimization))
        for topic, kind, receive in (
                ("joint_states", JointState, self.on_joints), ("joint_friction", msg.JointFriction, self.on_friction),
                ("controller_states", msg.ControllerStates, self.on_controllers), ("signals", msg.Signals, self.on_signals),
                ("commands", msg.Commands, self.on_commands), ("/diagnostics", DiagnosticArray, self.on_diagnostics),
                (f"{simulation}/parameter_descriptions", reconfigure.ConfigDescription, self.on_descriptions),
                (f"{simulation}/parameter_updates", reconfigure.Config, self.on_values),
                ("optimization_progress", msg.OptimizationProgress, self.on_optimization),
                ("identification_progress", msg.IdentificationProgress, self.on_identification),
                ("optimize/status", GoalStatusArray, self.on_goals), ("identify/status", GoalStatusArray, self.on_goals),
                ("optimize/result", msg.OptimizeActionResult, self.on_optimized),
                ("identify/result", msg.IdentifyActionResult, self.on_identified)):
            rospy.Subscriber(topic, kind, receive, queue_size=1000, tcp_nodelay=True)

    def show(self, topic, message, *quantities):
        """A frame to the curves; the field of a message has the name of its quantity."""
        columns = [getattr(message, quantity or "value") for quantity in quantities]
        # A joint state may leave out a quantity altogether.
        if all(len(column) == len(message.name) for column in columns):
            self._board.curves.add(topic, message.header.stamp.to_sec(), message.name, quantities, columns)

    def on_joints(self, message):
        self.show("joint_states", message, "position", "velocity", "effort")

    def on_friction(self, message):
        self.show("joint_friction", message, "friction", "normal_force", "sliding_velocity")

    def on_controllers(self, message):
        if message.name != self._controllers:
            self._controllers = message.name
            self._board.tell("commands", controllers=self.with_setpoint(message.name))
        self.show("controller_states", message, "setpoint", "input", "error", "integral", "output")

    def on_signals(self, message):
        self.show("signals", message, "")

    def with_setpoint(self, names):
        """The controllers whose set-point the node takes: it listens to their topics."""
        import rosgraph
        _, subscribed, _ = rosgraph.Master(self._ros.get_name()).getSystemState()
        heard = {topic for topic, nodes in subscribed if self._ros.resolve_name(self._simulation) in nodes}
        return [name for name, topic in setpoint_topics(names).items() if self._ros.resolve_name(topic) in heard]

    def on_commands(self, message):
        self._board.tell("commands", efforts=dict(zip(message.joints, map(number, message.efforts))),
                         setpoints=dict(zip(message.controllers, map(number, message.setpoints))))

    def on_diagnostics(self, message):
        for status in message.status:
            for part in ("simulation", "optimization"):
                if status.name.startswith(self._board.read(part, "name")[1:] + ":"):
                    values = {value.key: value.value for value in status.values}
                    if part == "simulation":
                        self.correct(values)
                    self._board.tell(part, seen=time.monotonic(), level=status.level, message=status.message, values=values)
                    if part == "optimization" and not status.message.startswith(("optimizing", "identifying")):
                        self.note_rest()

    def forget_pauses(self):
        # Time of a run that is paused, when one was seen, and when the run answered last.
        self._stands_at, self._stood, self._answered = None, -math.inf, -math.inf

    def correct(self, values):
        """Diagnostics come once a second. While the run stands they may be older than the answer to a step, whose time then counts; and the
        real-time factor of a run that stands, or has just gone on, is an old one."""
        now = time.monotonic()
        if values.get("waits for") == STANDS:
            self._stood = now
            if self._stands_at is not None:
                values["time of the run"] = self._stands_at
        elif now - self._answered > AFTER_PAUSE:  # it goes on; diagnostics may be older than the answer
            self._stands_at = None
        if now - self._stood < AFTER_PAUSE:
            values.pop("real-time factor", None)

    def note_answer(self, what, message):
        """What an answer of the run tells: whether it stands, and where."""
        values = dict(self._board.read("simulation", "values"))
        if what in ("pause", "resume"):
            values["waits for"] = STANDS if what == "pause" else "nothing"
        found = re.search(r"\bt = ([-+0-9.e]+) s\b", message)
        self._answered, self._stands_at = time.monotonic(), None
        if found:
            values["time of the run"] = found[1]
            self._stands_at = found[1] if what in ("pause", "step") else None
        self.correct(values)
        self._board.tell("simulation", values=values)

    def note_rest(self):
        """Jobs of services tell no result here, and the state may be older than a job that has just begun."""
        told = self._board.read("job", "told")
        if time.monotonic() - told.get("at", -math.inf) > 2.0:
            self._board.tell("job", running=False)

    def on_descriptions(self, message):
        low, high, initial = ({each.name: number(each.value) for each in config.doubles} for config in (message.min, message.max, message.dflt))
        self._board.tell("parameters", described=[
            {"name": each.name, "label": each.description, "min": low[each.name], "max": high[each.name], "initial": initial[each.name]}
            for group in message.groups for each in group.parameters])

    def on_values(self, message):
        self._board.tell("parameters", values={each.name: number(each.value) for each in message.doubles})

    def tell_progress(self, kind, message, best, names):
        told = {"job": message.job, "stage": message.stage, "done": message.done, "of": message.of, "evaluation": message.evaluation,
                "best": number(best), "at_most": message.at_most, "at": time.monotonic(), "values": dict(zip(names, map(number, message.values)))}
        with self._lock:
            # The result of a job may overtake its messages. Zero seconds are left in the last of them, after which its files are written.
            is_late = self._ended is not None and message.header.stamp <= self._ended
            left = 0.0 if is_late else number(message.seconds_left)
            result = self._board.read("job", "result") if is_late else None
            self._board.tell("job", kind=kind, told=dict(told, left=left), running=left != 0.0, result=result)

    def on_optimization(self, message):
        self.tell_progress("optimization", message, message.best_objective, message.parameters)

    def on_identification(self, message):
        self.tell_progress("identification", message, message.cost, message.names)

    def on_goals(self, message):
        self._goals.update({each.goal_id.id: each for each in message.status_list})

    def tell_result(self, kind, message, rows, columns, values, summary):
        if message.status.status == self._rejected:  # one that has not begun; who asked for it is told
            return
        result = message.result
        if result.bag:
            self._board.bag = result.bag
        reason = result.message or result.termination.replace("_", " ")
        sentence = result.code if reason == result.code else f"{result.code}: {reason}"
        with self._lock:
            self._ended = message.header.stamp
            self._board.tell("job", kind=kind, running=False, told=dict(self._board.read("job", "told"), left=0.0), result={
                "job": result.job, "success": result.success, "message": sentence,
                "summary": summary, "columns": columns, "rows": rows, "values": values,
                "warnings": [f"{each.code}: {each.message}" for each in result.warnings], "bag": result.bag})

    def on_optimized(self, message):
        result = message.result
        tuned = [number(value) for value in result.tuned]
        self.tell_result("optimization", message, [list(row) for row in zip(result.parameters, map(number, result.initial), tuned)],
                         ["parameter", "initial", "tuned"], dict(zip(result.parameters, tuned)),
                         f"objective {result.initial_objective:.6g} → {result.objective:.6g} after {result.evaluations} evaluations" if tuned else "")

    def on_identified(self, message):
        result = message.result
        rows = [[each.name, *map(number, (each.start, each.value, each.low, each.high))] for each in result.numbers]
        summary = " ".join([f"{result.rank} of {len(rows)} numbers are determined by the data.", *result.undetermined]) if rows else ""
        self.tell_result("identification", message, rows, ["number", "start", "value", "low", "high"],
                         dict(zip(result.parameters, map(number, result.values))), summary)

    def call(self, name, kind, *arguments):
        import rosgraph
        try:
            try:
                self._ros.wait_for_service(name, PATIENCE)
            except self._ros.ROSException:
                if rosgraph.Master(self._ros.get_name()).lookupService(self._ros.resolve_name(name)):  # which raises for one that is not known
                    self._ros.wait_for_service(name, LATENESS)
            return self._ros.ServiceProxy(name, kind)(*arguments)
        except (self._ros.ROSException, self._ros.ServiceException, rosgraph.MasterException) as error:
            raise Refused(f"{self._ros.resolve_name(name)}: no answer: {error}") from error

    def heard(self, topic, kind):
        """A publisher to which a node listens. Raises Refused."""
        with self._lock:
            if topic not in self._publishers:
                self._publishers[topic] = self._ros.Publisher(topic, kind, queue_size=10, tcp_nodelay=True)
            publisher = self._publishers[topic]
        begin = time.monotonic()
        while publisher.get_num_connections() == 0:
            waited = time.monotonic() - begin
            if waited > LATENESS or (waited > PATIENCE and not self.is_registered(topic)):
                raise Refused(f"{self._ros.resolve_name(topic)}: no node listens to it")
            time.sleep(0.02 if waited < PATIENCE else 0.2)
        return publisher

    def is_registered(self, topic):
        """Whether the master knows a node that listens to the topic."""
        import rosgraph
        _, subscribed, _ = rosgraph.Master(self._ros.get_name()).getSystemState()
        return any(name == self._ros.resolve_name(topic) and nodes for name, nodes in subscribed)

    def do(self, what, fields):
        """Does what a page asks for. Returns a sentence. Raises Refused."""
        if what in ("pause", "resume", "step", "restart", "cancel"):
            answer = self.call(f"{self._optimization if what == 'cancel' else self._simulation}/{what}", self._trigger)
            if not answer.success:
                raise Refused(answer.message)
            if what in ("pause", "resume", "step", "restart"):
                self.note_answer(what, answer.message)
            return answer.message
        if what == "parameters":
            return self.set_parameters(fields["values"])
        name, value = fields.get("name"), fields.get("value")
        if what == "effort":
            if name not in self._board.read("commands", "efforts"):
                raise Refused(f"{name}: no joint of this simulation that takes efforts")
            self.heard(f"{self._simulation}/command/effort", self._joint_state).publish(self._joint_state(name=[name], effort=[value]))
            return f"{name}: effort {value:.6g} is commanded"
        if what == "setpoint":
            if name not in self._board.read("commands", "controllers"):
                raise Refused(f"{name}: no controller of this study with a set-point")
            self.heard(setpoint_topics(self._controllers)[name], self._float).publish(self._float(value))
            return f"{name}: set-point {value:.6g} is commanded"
        return self.start_job(what)

    def is_served(self, topic):
        """Whether the node that publishes the topic sends it here. A node that was started anew begins with that a moment later, and what it
        publishes before is lost."""
        import rosgraph
        topic, name = self._ros.resolve_name(topic), self._ros.get_name()
        master = rosgraph.Master(name)
        published, _, _ = master.getSystemState()
        for node in (each for row in published if row[0] == topic for each in row[1]):
            try:
                _, _, connections = xmlrpc.client.ServerProxy(master.lookupNode(node)).getBusInfo(name)
            except (OSError, rosgraph.MasterException, xmlrpc.client.Error):  # it has ended
                continue
            if any((peer, direction, sent) == (name, "o", topic) for _, peer, direction, _, sent, *_ in connections):
                return True
        return False

    def start_job(self, what):
        """Returns when the node has the goal. A node that was started anew is sent it again: the first one may have gone to the connection of
        the node before. A goal that it has is not taken twice."""
        goal = (self._msg.OptimizeActionGoal if what == "optimize" else self._msg.IdentifyActionGoal)()
        goal.header.stamp = goal.goal_id.stamp = self._ros.Time.now()
        goal.goal_id.id = f"{self._ros.get_name()}-{uuid.uuid4()}"
        end = time.monotonic() + LATENESS
        while goal.goal_id.id not in self._goals:
            if time.monotonic() > end:
                raise Refused(f"{self._ros.resolve_name(what)}: the node does not take the job")
            publisher = self.heard(f"{what}/goal", type(goal))
            if self.is_served(f"{what}/result"):
                publisher.publish(goal)
            time.sleep(0.3)
        status = self._goals[goal.goal_id.id]
        if status.status == self._rejected:
            raise Refused(status.text)
        return f"{what}: the job has begun"

    def set_parameters(self, values):
        wanted = self._reconfigure.Config(doubles=[self._reconfigure.DoubleParameter(*each) for each in values.items()])
        answer = self.call(f"{self._simulation}/set_parameters", self._set_parameters, wanted)
        now = {each.name: each.value for each in answer.config.doubles}
        self._board.tell("parameters", values={name: number(value) for name, value in now.items()})
        other = [f"{name} = {value:.6g} was not taken" + (f", it is {now[name]:.6g}" if name in now else "; there is no such parameter")
                 for name, value in values.items() if now.get(name) != value]
        if other:
            raise Refused("; ".join(other) + "; the warnings of the run say why")
        return ", ".join(f"{name} = {value:.6g}" for name, value in values.items())
