# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What the page shows: the curves of signals, and the state of nodes, parameters, commands and the job."""
import array
import collections
import itertools
import json
import math
import threading
import time

MOST_FRAMES = 3000  # kept of each signal
SILENCE = 4.0  # [s] without diagnostics, of which nodes send one each second, or without frames, after which a node does not answer


def number(value):
    """A JSON number, or None for what is not finite."""
    return value if math.isfinite(value) else None


class Curves:
    """The last numbers of each signal, by the stamps of its frames. Thread-safe. Frames of one topic make a track."""

    def __init__(self):
        self._lock = threading.Lock()
        self._generation, self._tracks, self._places, self._begin = 0, {}, {}, None

    def add(self, topic, stamp, objects, quantities, columns):
        """A frame with the numbers columns[q][k] of quantity q of object k. Other names, or a clock that was set back, begin anew."""
        objects = tuple(objects)
        with self._lock:
            track = self._tracks.get(topic)
            if track and (track["objects"] != objects or stamp < track["rows"][-1][0]):
                self._generation += 1
                self._tracks, self._places, self._begin, track = {}, {}, None, None
            if track is None:
                self._begin = stamp if self._begin is None else self._begin
                track = self._tracks[topic] = {"objects": objects, "rows": collections.deque(maxlen=MOST_FRAMES), "count": 0}
                track["names"] = names = [f"{each}/{quantity}" if quantity else each for quantity in quantities for each in objects]
                for place, name in enumerate(names):
                    self._places.setdefault(name, (topic, place))
            track["seen"] = time.monotonic()
            track["rows"].append((stamp, array.array("d", itertools.chain.from_iterable(columns))))
            track["count"] += 1

    def silent(self, is_alive):
        """The signals of topics that have had no frame for a while: of all topics if the node that publishes them does not answer, else of those
        that others have left behind, such as of a robot before. A run that is paused has no frames either."""
        with self._lock:
            now = max((track["seen"] for track in self._tracks.values()), default=0.0) if is_alive else time.monotonic()
            return sorted(name for topic, track in self._tracks.items() if now - track["seen"] > SILENCE for name in track["names"] if self._places[name][0] == topic)

    def names(self):
        with self._lock:
            return sorted(self._places)

    def since(self, names, cursor):
        """The new points [time, value] of each of these signals, and the cursor for the next call; None is the first cursor."""
        with self._lock:
            generation, marks = cursor if cursor and cursor[0] == self._generation else (self._generation, {})
            points, ahead = {}, {}
            for name in names:
                if name not in self._places:
                    continue
                topic, place = self._places[name]
                track = self._tracks[topic]
                first = max(marks.get(name, 0) - (track["count"] - len(track["rows"])), 0)
                rows = itertools.islice(track["rows"], first, None)
                new = [[round(stamp - self._begin, 4), number(float(f"{row[place]:.6g}"))] for stamp, row in rows]
                ahead[name] = track["count"]
                if new:
                    points[name] = new
            return points, (generation, ahead)


class Board:
    """What the page shows besides curves: some parts with fields. Thread-safe."""

    def __init__(self):
        self._lock = threading.Lock()
        self.curves = Curves()
        self.bag = ""  # of the last job that has one
        node = {"name": "", "seen": -math.inf, "level": 0, "message": "", "values": {}}
        self._parts = {"simulation": dict(node), "optimization": dict(node),
                       "parameters": {"described": [], "values": {}},
                       # Controllers that take a set-point, and the set-points in effect, which only some of them have.
                       "commands": {"efforts": {}, "setpoints": {}, "controllers": []},
                       "job": {"kind": "", "running": False, "told": {}, "result": None}}

    def tell(self, part, **fields):
        with self._lock:
            self._parts[part].update(fields)

    def read(self, part, field):
        with self._lock:
            return self._parts[part][field]

    def text(self):
        """The state as JSON."""
        names = self.curves.names()
        with self._lock:
            state = {part: dict(fields) for part, fields in self._parts.items()}
            for node in ("simulation", "optimization"):
                state[node]["answers"] = time.monotonic() - state[node].pop("seen") < SILENCE
            state["silent"] = self.curves.silent(state["simulation"]["answers"])
            state["job"]["running"] = state["job"]["running"] and state["optimization"]["answers"]
            return json.dumps({**state, "signals": names}, allow_nan=False)
