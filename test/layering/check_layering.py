#!/usr/bin/python3
# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""Checks the order of the rooms: includes and declarations run one way, ROS stays in ros/, files and functions stay short.

Usage: check_layering.py REPOSITORY. Prints each violation as file:line and exits with 1 if there is any.
"""
import math
import pathlib
import re
import statistics
import sys

# A room may include itself, its own folders and the rooms of earlier rows, never its neighbours in the same row.
ROWS = [
    ["text"],
    ["math"],
    ["codegen"],
    ["sparse"],
    ["forces"],
    ["joints"],
    ["description"],
    ["sampling"],
    ["statistics"],
    ["recordings"],
    ["mechanism"],
    ["reading"],
    ["control"],
    ["system"],
    ["elements"],
    ["equations"],
    ["assembly"],
    ["observation"],
    ["linear"],
    ["problem"],
    ["integration"],
    ["sensitivity"],
    ["engine"],
    ["ensemble"],
    ["optimization"],
    ["identification"],
    ["excitation"],
    ["statics"],
    ["jobs"],
    ["mpi"],
    ["cli", "python", "ros"],
]
ROW_OF = {room: row for row, rooms in enumerate(ROWS) for room in rooms}
# The same order of the rooms inside a room; "" are the files beside them.
INNER_ROWS = {
    "reading": [[""], ["xml", "yaml"], ["urdf"], ["study"]],
    "identification": [["fit"], ["effort"], ["motion"], ["comparison"], [""]],
    "ros": [["scene"], ["bags"], ["common"], ["apply", "simulation"], ["jobs"], ["nodes"], [""]],
}
INNER_ROW_OF = {room: {inner: row for row, rooms in enumerate(rows) for inner in rooms} for room, rows in INNER_ROWS.items()}
# Features that most users never enter, and the places outside them that know them: all others would build without.
FEATURES = {
    "mpi/": ("cli/", "ros/nodes/"),
    "excitation/": ("jobs/", "cli/", "ros/bags/"),
    "ros/apply/": ("ros/jobs/", "ros/nodes/"),
    "jobs/journal": ("cli/", "ros/jobs/"),
}
# The room that each public header belongs to; the rooms after it may include it.
PUBLIC = {
    "counts.h": "assembly",
    "error.h": "text",
    "event.h": "text",
    "frame.h": "observation",
    "gradient.h": "sensitivity",
    "optimization.h": "optimization",
    "optimizer_options.h": "description",
    "parameter.h": "description",
    "problem.h": "problem",
    "simulation.h": "integration",
    "source_text.h": "text",
    "statistics.h": "integration",
    "status.h": "text",
    "version.h": "text",
    "warning.h": "text",
}
ROS_HEADER = re.compile(
    r"^(ros|rosbag|roscpp|actionlib|tf2?(_ros|_msgs)?|diagnostic_updater|xmlrpcpp|topic_tools|rosgraph_msgs|\w+_msgs)/|^(XmlRpc\w*|tf2_ros)\b")
OWN_MESSAGE = re.compile(r"^mechanism_codesign/[A-Z]\w*\.h$")
FORWARD_DECLARATION = re.compile(r"^\s*(?:class|struct)\s+(\w+);")
DEFINITION = re.compile(r"^(?:class|struct)\s+(\w+)\b[^;]*\{", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
MAX_FILE = 400
MAX_FUNCTION = 60
MAX_DEPTH = 15  # of the quoted includes of a header


def room_of(header):
    """The room of ours that an include names, or None."""
    parts = header.split("/")
    if parts[0] == "mechanism_codesign":
        return PUBLIC.get(parts[-1])
    if parts[0] == "src":
        parts = parts[1:]
    return parts[0] if len(parts) > 1 and parts[0] in ROW_OF else None


def room_of_file(name):
    """The room of a file of ours, from its path below the root, or None."""
    if name.parts[0] == "include":
        return PUBLIC.get(name.name)
    return name.parts[1] if len(name.parts) > 2 and name.parts[1] in ROW_OF else None


def is_ros(header, in_brackets):
    """Whether a header is from ROS. Our own headers below src/ros/ are included in quotes, those of ROS in brackets."""
    return bool((in_brackets and ROS_HEADER.match(header)) or OWN_MESSAGE.match(header))


def check_include(room, header, in_brackets):
    """Why `room` must not include `header`, or None."""
    if room != "ros" and is_ros(header, in_brackets):
        return f"{room}/ includes the ROS header <{header}>"
    other = room_of(header)
    if other is None or other == room or (room == "ros" and is_ros(header, in_brackets)):
        return None
    if ROW_OF[other] >= ROW_OF[room]:
        return f"{room}/ includes {other}/, which does not stand before it"
    return None


def inner_room(parts):
    """The room inside the first room of a path below src/; empty for a file beside those rooms, None where there are none."""
    if parts[0] not in INNER_ROWS:
        return None
    return parts[1] if len(parts) > 2 else ""


def check_inner_include(room, inner, header):
    """Why a file of the room `inner` inside `room` must not include `header`, or None."""
    parts = header.split("/")
    other = inner_room(parts)
    rows = INNER_ROW_OF.get(room, {})
    if inner is None or parts[0] != room or inner == other or rows.get(other, len(rows)) < rows[inner]:
        return None
    return f"{room}/{inner}/ includes {'/'.join(filter(None, (room, other)))}/, which does not stand before it"


def check_feature(name, header):
    """Why the file `name` below src/ must not know the feature that `header` belongs to, or None."""
    for feature, places in FEATURES.items():
        if header.startswith(feature) and not name.startswith((feature, *places)):
            return f"{feature} is a feature that only {', '.join(places)} may include"
    return None


def defining_rooms(sources):
    """The room that defines each class of ours, from the texts by file."""
    return {name: room_of_file(path) for path, text in sources.items() for name in DEFINITION.findall(text)}


def check_declaration(room, line, room_of_class):
    """Why `room` must not declare the class that a line declares, or None: a forward declaration can bypass the check of includes."""
    match = FORWARD_DECLARATION.match(line)
    other = room_of_class.get(match.group(1)) if match else None
    if other is None or room == other or ROW_OF[other] < ROW_OF[room]:
        return None
    return f"{room}/ declares {match.group(1)}, which {other}/ defines above it"


def blank_comments_and_strings(text):
    """The same text, line for line, with the insides of comments, strings and characters blanked, so that every brace left is code."""
    pattern = re.compile(
        r'R"(?P<tag>[^()\s\\]*)\(.*?\)(?P=tag)"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), text)


def without_directives(code):
    """The same, line for line, without those of the preprocessor."""
    return "\n".join("" if line.lstrip().startswith("#") else line for line in code.split("\n"))


NOT_A_FUNCTION = re.compile(r"^\s*(namespace|class|struct|union|enum|extern)\b|=\s*$")


def function_lengths(text):
    """(first line, number of lines) of each outermost brace block that is a function body."""
    code = without_directives(blank_comments_and_strings(text))
    lengths, stack, head_start = [], [], 0
    for position, character in enumerate(code):
        if character == "{":
            head = re.sub(r"template\s*<[^{}]*?>\s*(?=class|struct|\w)", "", code[head_start:position]).strip()
            inside_function = any(kind == "function" for kind, _ in stack)
            is_function = not inside_function and "(" in head and not NOT_A_FUNCTION.search(head)
            first = head_start + len(code[head_start:position]) - len(code[head_start:position].lstrip())
            stack.append(("function" if is_function else "other", first))
            head_start = position + 1
        elif character == "}" and stack:
            kind, first = stack.pop()
            if kind == "function":
                line = code.count("\n", 0, first) + 1
                lengths.append((line, code.count("\n", first, position) + 1))
            head_start = position + 1
        elif character == ";" or (character == ":" and code[head_start:position].strip() in ("public", "protected", "private")):
            head_start = position + 1
    return lengths


SCOPE = re.compile(r"\bnamespace\b(?P<namespace>[^;{}()=]*)$|\b(?:class|struct|enum(?:\s+class)?|union)\s+(?:\[\[\w+\]\]\s*)?(?P<type>\w+)\s*(?:final\b\s*)?(?::[^:].*)?$", re.DOTALL)


def types_in(text):
    """(namespaces, name, line) of each type that a source defines in a namespace; "" is an anonymous one."""
    code = without_directives(blank_comments_and_strings(text))
    types, scopes, head_start = [], [], 0
    for position, character in enumerate(code):
        if character == "{":
            match = SCOPE.search(re.sub(r"template\s*<[^{}]*?>\s*(?=class|struct)", "", code[head_start:position]).rstrip())
            if match and match["type"] and None not in scopes:
                types.append((tuple(scopes), match["type"], code.count("\n", 0, position) + 1))
            scopes.append(match["namespace"].strip() if match and match["namespace"] is not None else None)
            head_start = position + 1
        elif character == "}":
            if scopes:
                scopes.pop()
            head_start = position + 1
        elif character == ";":
            head_start = position + 1
    return types


def equal_names(sources):
    """Two types of one name in one namespace. If no unit includes both, no compiler reports them, and the program has one of the two everywhere. An
    anonymous namespace counts as the one around it, where it is not that of another file."""
    found, violations = {}, []
    for path, text in sources.items():
        for namespaces, name, line in types_in(text):
            others = found.setdefault((tuple(filter(None, namespaces)), name), [])
            violations += [f"{path}:{line}: {name} is also defined in {other}:{there}"
                           for other, there, is_anonymous in others if not (is_anonymous and "" in namespaces and other != path)]
            others.append((path, line, "" in namespaces))
    return violations


def depths_of(sources):
    """The length of the longest chain of quoted includes below each header; infinite for a circle."""
    headers = {"/".join(path.parts[1:]): text for path, text in sources.items() if path.suffix == ".h"}
    included = {name: [header for bracket, header in (match.groups() for match in map(INCLUDE.match, text.splitlines()) if match)
                       if bracket == '"' and header in headers] for name, text in headers.items()}
    depths = {}

    def depth(name, chain):
        if name in chain:
            return math.inf
        if name not in depths:
            depths[name] = max((1 + depth(header, chain | {name}) for header in included[name]), default=0)
        return depths[name]

    for name in headers:
        depth(name, frozenset())
    return depths


def check(root):
    """All violations below `root`, as sentences, and the number of lines of each file."""
    violations, lines_of = [], {}
    sources = {path.relative_to(root): path.read_text(encoding="utf-8")
               for path in sorted(list(root.glob("src/**/*")) + list(root.glob("include/**/*"))) if path.suffix in (".h", ".cc")}
    room_of_class = defining_rooms(sources)
    for name, text in sources.items():
        room = room_of_file(name)
        lines = text.splitlines()
        lines_of[str(name)] = len(lines)
        inner = inner_room(name.parts[1:]) if room else None
        if room is None or (inner is not None and inner not in INNER_ROW_OF[room]):
            violations.append(f"{name}:1: {name.parent.name}/ has no place in the order of the rooms")
            continue
        for number, line in enumerate(lines, start=1):
            match = INCLUDE.match(line)
            if match:
                in_brackets = match.group(1) == "<"
                header = match.group(2)
                reason = check_include(room, header, in_brackets) or (
                    None if in_brackets else check_inner_include(room, inner, header) or check_feature("/".join(name.parts[1:]), header))
            else:
                reason = check_declaration(room, line, room_of_class)
            if reason:
                violations.append(f"{name}:{number}: {reason}")
        if len(lines) > MAX_FILE:
            violations.append(f"{name}:{len(lines)}: {len(lines)} lines, at most {MAX_FILE}")
        for first, length in function_lengths(text):
            if length > MAX_FUNCTION:
                violations.append(f"{name}:{first}: a function of {length} lines, at most {MAX_FUNCTION}")
    violations += equal_names(sources)
    for name, depth in depths_of(sources).items():
        if depth > MAX_DEPTH:
            violations.append(f"{name}:1: " + ("an include chain leads back to itself" if depth == math.inf else f"includes {depth} headers deep, at most {MAX_DEPTH}"))
    for path in sorted(list(root.glob("test/**/*")) + list(root.glob("benchmark/**/*"))):
        if path.suffix in (".h", ".cc") and (count := len(path.read_text().splitlines())) > MAX_FILE:
            violations.append(f"{path.relative_to(root)}:{count}: {count} lines, at most {MAX_FILE}")
    return violations, lines_of


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    violations, lines_of = check(pathlib.Path(sys.argv[1]))
    if not lines_of:
        sys.exit(f"no sources below {sys.argv[1]}")
    print(f"{len(lines_of)} files, median {statistics.median(lines_of.values()):g} lines, longest {max(lines_of, key=lines_of.get)}")
    for violation in violations:
        print(violation)
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
