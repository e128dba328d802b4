# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""What a page may ask for."""
import json
import math

FIELDS = {"parameters": {"values"}, "effort": {"name", "value"}, "setpoint": {"name", "value"},
          **{word: set() for word in ("pause", "resume", "step", "restart", "optimize", "identify", "cancel")}}


class Refused(Exception):
    """What a page asks for and cannot have; the text is a sentence for the user."""


def is_number(value):
    try:
        return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:  # an integer beyond all floats
        return False


def is_name(text):
    """JSON can have half a character, which no message can."""
    return isinstance(text, str) and text == text.encode("utf-8", "ignore").decode()


def read_request(content):
    """What a page asks for, and its fields. Raises Refused."""
    try:
        request = json.loads(content)
    except (ValueError, RecursionError) as error:
        raise Refused(f"not JSON: {error}") from error
    if not isinstance(request, dict) or not isinstance(request.get("do"), str) or request["do"] not in FIELDS:
        raise Refused(f"do: unknown (allowed: {', '.join(sorted(FIELDS))})")
    what = request.pop("do")
    if set(request) != FIELDS[what]:
        raise Refused(f"{what}: wrong fields (value: {', '.join(sorted(request)) or 'none'}, needed: {', '.join(sorted(FIELDS[what])) or 'none'})")
    values = request.get("values", {})
    pairs = [*(values.items() if isinstance(values, dict) else [(None, None)]), *([(request["name"], request["value"])] if "name" in request else [])]
    if not all(is_name(name) and is_number(value) for name, value in pairs):
        raise Refused(f"{what}: a name needs a finite number")
    return what, request
