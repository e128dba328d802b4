# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
"""How a program writes the file that a user names: whole or not at all, and never in place of what is no file."""
import errno
import os
import secrets
import stat


def status_of(path):
    """What stands at a path, links followed; None: nothing."""
    try:
        return os.stat(path)
    except FileNotFoundError:
        return None


def is_stream(path, status):
    """Whether bytes go straight to what stands there: a device, a FIFO, or a stream that a shell has opened, such as /dev/stdout."""
    resolved = os.path.join(os.path.realpath(os.path.dirname(path)), "")
    return status is not None and (not stat.S_ISREG(status.st_mode) or resolved.startswith(("/dev/", "/proc/")))


def write_output(path, text):
    """Writes a text to a path.

    A file is replaced when the new one is complete; a link stays, and the file to which it leads is replaced. Devices and FIFOs stay what they are
    and get the text. After an error there is the former file, and nothing else: no file that is begun. Raises OSError, of a folder, too."""
    path, content = os.fspath(path), text.encode("utf-8")
    status = status_of(path)
    if status is not None and stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), path)
    if is_stream(path, status):
        with open(path, "wb", buffering=0) as stream:
            write_all(stream.fileno(), content)
        return
    place = os.path.realpath(path)
    part = os.path.join(os.path.dirname(place), f".{os.path.basename(place)[:100]}.{secrets.token_hex(4)}.part")
    descriptor = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
    try:
        try:
            if status is not None:
                os.fchmod(descriptor, stat.S_IMODE(status.st_mode))
            write_all(descriptor, content)
        finally:
            os.close(descriptor)
        os.replace(part, place)
    except BaseException:
        os.unlink(part)
        raise


def write_all(descriptor, content):
    while content:
        content = content[os.write(descriptor, content):]
