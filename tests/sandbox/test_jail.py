"""What runs in a jail reads what it may, gives its bytes, and can do nothing else.

Each attack is raw Python that tries one thing. It has to be refused by the kernel, and to leave
nothing behind. So that a refusal means something, the attacks that do no harm are first shown to
succeed in an ordinary child.
"""

from __future__ import annotations

import ctypes
import errno
import fcntl
import io
import json
import os
import platform
import re
import signal
import socket
import stat
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.effort import sample
from tests.waiting import PATIENCE, wait_for
from yamaro.sandbox import jail
from yamaro.sandbox.jail import JailLimits, pack, run_jailed, unpack

if not sys.platform.startswith("linux"):
    pytest.skip("a jail needs Linux", allow_module_level=True)

from yamaro.sandbox.jail import calls, child, landlock, protocol, seccomp

WHY_NOT = jail.check_available()
in_jail = pytest.mark.skipif(WHY_NOT is not None, reason=f"no jail here: {WHY_NOT}")

Attack = Callable[[Path], object]
USUAL: dict[str, Any] = {"seconds": PATIENCE, "cpu_seconds": 120, "memory": 1 << 30}
REPOSITORY = Path(__file__).parents[2]


def run(work: Callable[[], bytes], *readable: Path, **limits: Any) -> bytes:
    limits = {**USUAL, **limits}
    return run_jailed(work, readable=[str(p) for p in readable], limits=JailLimits(**limits))


@pytest.fixture(autouse=True)
def nothing_is_leaked() -> Iterator[None]:
    files, had_children = set(os.listdir("/proc/self/fd")), has_children()
    yield
    assert set(os.listdir("/proc/self/fd")) <= files
    assert has_children() <= had_children  # other tests of this process may keep one


def has_children() -> bool:
    """Tell whether this process has children, dead or alive."""
    try:
        os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    except ChildProcessError:
        return False
    return True


def furnish(folder: Path) -> Path:
    """Make a folder to be read, with a secret beside it, and return it."""
    robot = folder / "robot"
    (robot / "sub").mkdir(parents=True)
    (robot / "robot.yaml").write_text("robot: {name: r}\n")
    (robot / "mesh.stl").write_bytes(b"solid")
    (folder / "secret.txt").write_text("swordfish")
    (robot / "link").symlink_to("../secret.txt")
    (robot / "up").symlink_to("..")
    (robot / "environment").symlink_to("/proc/self/environ")
    return robot


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    return furnish(tmp_path)


def snapshot(folder: Path) -> list[tuple[Any, ...]]:
    """Return all there is to know of the files in a folder."""
    found = []
    for path in sorted(folder.rglob("*")):
        status = path.lstat()
        content = path.read_bytes() if stat.S_ISREG(status.st_mode) else b""
        fields = (status.st_mode, status.st_uid, status.st_mtime_ns, status.st_ctime_ns)
        found.append((str(path), *fields, status.st_nlink, content))
    return found


# --- attacks ----------------------------------------------------------------------------------


def raw(name: str, *arguments: int) -> int:
    """Make a system call by its number."""
    number = RAW_CALLS[name][0 if platform.machine() == "x86_64" else 1]
    if number is None:
        raise OSError(errno.ENOSYS, name)
    result = calls.call(number, *arguments)
    if result < 0:
        raise OSError(ctypes.get_errno(), name)
    return result


def address(text: str | bytes) -> int:
    data = text.encode() if isinstance(text, str) else text
    buffer = ctypes.create_string_buffer(data)
    KEPT.append(buffer)
    return ctypes.addressof(buffer)


KEPT: list[object] = []
NOTHING = (1 << 64) - 1  # an address where nothing is

# The calls that no attack below makes by way of Python, and their numbers on x86-64 and aarch64.
RAW_CALLS: dict[str, tuple[int | None, int | None]] = {
    "acct": (163, 89),
    "add_key": (248, 217),
    "adjtimex": (159, 171),
    "bpf": (321, 280),
    "capset": (126, 91),
    "chroot": (161, 51),
    "clone": (56, 220),
    "clone3": (435, 435),
    "delete_module": (176, 106),
    "epoll_create1": (291, 20),
    "eventfd2": (290, 19),
    "execveat": (322, 281),
    "fanotify_init": (300, 262),
    "finit_module": (313, 273),
    "fork": (57, None),
    "fsopen": (430, 430),
    "init_module": (175, 105),
    "inotify_init1": (294, 26),
    "io_uring_setup": (425, 425),
    "ioperm": (173, None),
    "kcmp": (312, 272),
    "kexec_load": (246, 104),
    "keyctl": (250, 219),
    "landlock_create_ruleset": (444, 444),
    "memfd_create": (319, 279),
    "memfd_secret": (447, 447),
    "mlockall": (151, 230),
    "modify_ldt": (154, None),
    "mount": (165, 40),
    "mount_setattr": (442, 442),
    "move_mount": (429, 429),
    "mq_open": (240, 180),
    "msgget": (68, 186),
    "name_to_handle_at": (303, 264),
    "open_by_handle_at": (304, 265),
    "open_tree": (428, 428),
    "openat": (257, 56),
    "openat2": (437, 437),
    "perf_event_open": (298, 241),
    "personality": (135, 92),
    "pidfd_getfd": (438, 438),
    "pidfd_open": (434, 434),
    "pidfd_send_signal": (424, 424),
    "pivot_root": (155, 41),
    "prctl": (157, 167),
    "prlimit64": (302, 261),
    "process_vm_readv": (310, 270),
    "process_vm_writev": (311, 271),
    "ptrace": (101, 117),
    "quotactl": (179, 60),
    "reboot": (169, 142),
    "request_key": (249, 218),
    "rt_sigqueueinfo": (129, 138),
    "seccomp": (317, 277),
    "semget": (64, 190),
    "setns": (308, 268),
    "setrlimit": (160, 164),
    "shmget": (29, 194),
    "signalfd4": (289, 74),
    "splice": (275, 76),
    "swapon": (167, 224),
    "syslog": (103, 116),
    "tgkill": (234, 131),
    "timerfd_create": (283, 85),
    "tkill": (200, 130),
    "umount2": (166, 39),
    "unshare": (272, 97),
    "userfaultfd": (323, 282),
    "vfork": (58, None),
    "vhangup": (153, 58),
}


def read(path: object) -> Attack:
    return lambda robot: Path(str(path).format(robot=robot, above=robot.parent)).read_bytes()[:1]


def open_with(flags: int) -> Attack:
    return lambda robot: os.open(robot / "robot.yaml", flags, 0o600)


def use_shell(robot: Path) -> None:
    if os.system(f"echo > {robot}/shell") != 0:
        raise PermissionError(errno.EPERM, "os.system")


def send(kind: int, target: Any) -> Attack:
    def attack(robot: Path) -> None:
        with socket.socket(socket.AF_UNIX, kind) as connection:
            connection.connect(target)

    return attack


def make_socket(*arguments: int) -> Attack:
    return lambda robot: socket.socket(*arguments).close()


def serve(robot: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)):
        pass


def call(name: str, *arguments: int | str) -> Attack:
    """Attack by one system call; texts among its arguments are passed as addresses."""

    def attack(robot: Path) -> int:
        numbers = [address(a) if isinstance(a, str) else a for a in arguments]
        return raw(name, *numbers)

    return attack


def open_by_openat2(robot: Path) -> int:
    how = struct.pack("QQQ", 0, 0, 0)
    secret = str(robot.parent / "secret.txt")
    return raw("openat2", -100, address(secret), address(how), len(how))


def read_parent_memory(robot: Path) -> int:
    here = ctypes.create_string_buffer(8)
    vector = struct.pack("PN", ctypes.addressof(here), 8)
    return raw("process_vm_readv", os.getppid(), address(vector), 1, address(vector), 1, 0)


def execute_by_descriptor(robot: Path) -> int:
    return raw("execveat", -100, address("/bin/true"), 0, 0, 0)


def own_signals_on_pipe(robot: Path) -> None:
    with open(robot / "robot.yaml", "rb") as file:
        fcntl.fcntl(file, fcntl.F_SETOWN, os.getppid())
        fcntl.fcntl(file, fcntl.F_SETFL, os.O_ASYNC)


def push_terminal_input(robot: Path) -> None:
    fcntl.ioctl(0, 0x5412, b"x")  # TIOCSTI


def lock(robot: Path) -> None:
    with open(robot / "robot.yaml", "rb") as file:
        fcntl.flock(file, fcntl.LOCK_EX)


def spawn(robot: Path) -> None:
    os.waitpid(os.posix_spawn("/bin/true", ["true"], {}), 0)


def fork(robot: Path) -> None:
    pid = os.fork()
    if pid == 0:
        os._exit(0)
    os.waitpid(pid, 0)


def set_limit(robot: Path) -> None:
    raw("setrlimit", 7, address(struct.pack("QQ", 100, 100)))


def map_shared(robot: Path) -> None:
    import mmap

    with open(robot / "robot.yaml", "r+b") as file:
        mmap.mmap(file.fileno(), 0).close()


def create(path: str) -> Attack:
    return lambda robot: os.open(f"{path}/yamaro-{os.getpid()}", os.O_CREAT | os.O_EXCL)


def pair(robot: Path) -> None:
    for end in socket.socketpair():
        end.close()


READING: dict[str, Attack] = {
    "a system file": read("/etc/passwd"),
    "a file beside the folder": read("{above}/secret.txt"),
    "a link to a file outside": read("{robot}/link"),
    "two dots": read("{robot}/sub/../../secret.txt"),
    "a link to the folder above": read("{robot}/up/secret.txt"),
    "a listing of the folder above": lambda robot: os.listdir(robot.parent),
    "a listing of the root": lambda robot: os.listdir("/"),
    "the environment": read("/proc/self/environ"),
    "the environment by a link": read("{robot}/environment"),
    "the memory map": read("/proc/self/maps"),
    "the root by /proc": read("/proc/self/root{above}/secret.txt"),
    "the state of a thread": read("/proc/thread-self/status"),
    "the parent's command": lambda robot: read(f"/proc/{os.getppid()}/cmdline")(robot),
    "the processes": lambda robot: os.listdir("/proc"),
    "a device": lambda robot: os.close(os.open("/dev/zero", os.O_RDONLY)),
}
WRITING: dict[str, Attack] = {
    "a new file": lambda robot: (robot / "new").write_text("x"),
    "an old file": lambda robot: (robot / "robot.yaml").write_text("x"),
    "appending": lambda robot: (robot / "robot.yaml").open("a"),
    "opening to read and write": open_with(os.O_RDWR),
    "opening to truncate": open_with(os.O_RDONLY | os.O_TRUNC),
    "opening to create": lambda robot: os.open(robot / "new", os.O_RDONLY | os.O_CREAT, 0o600),
    "opening an unnamed file": lambda robot: os.open(robot, os.O_TMPFILE | os.O_RDWR, 0o600),
    "truncating": lambda robot: os.truncate(robot / "robot.yaml", 0),
    "deleting": lambda robot: (robot / "mesh.stl").unlink(),
    "deleting a folder": lambda robot: (robot / "sub").rmdir(),
    "renaming": lambda robot: (robot / "mesh.stl").rename(robot / "other.stl"),
    "changing the mode": lambda robot: (robot / "robot.yaml").chmod(0o777),
    "changing the owner": lambda robot: os.chown(robot / "robot.yaml", os.getuid(), -1),
    "changing the time": lambda robot: os.utime(robot / "robot.yaml", (0, 0)),
    "a new folder": lambda robot: (robot / "folder").mkdir(),
    "a symbolic link": lambda robot: (robot / "soft").symlink_to("robot.yaml"),
    "a hard link": lambda robot: os.link(robot.parent / "secret.txt", robot / "hard"),
    "a fifo": lambda robot: os.mkfifo(robot / "fifo"),
    "locking": lock,
    "a shared map": map_shared,
    "/tmp": create("/tmp"),
    "/dev/shm": create("/dev/shm"),
    "/dev/null": lambda robot: os.open("/dev/null", os.O_WRONLY),
    "the shared memory of others": call("shmget", 0, 4096, 0o1600),
    "a file in memory": call("memfd_create", "x", 0),
}
STARTING: dict[str, Attack] = {
    "execv": lambda robot: os.execv("/bin/true", ["true"]),
    "execveat": execute_by_descriptor,
    "os.system": use_shell,
    "subprocess": lambda robot: subprocess.run(["/bin/true"], check=True),
    "posix_spawn": spawn,
    "os.fork": fork,
    "vfork": call("vfork"),
    "clone": call("clone", signal.SIGCHLD, 0, 0, 0, 0),
    "clone in a new namespace": call("clone", 0x10000000 | 0x10000 | 0x900, 0, 0, 0, 0),
    "clone3": call("clone3", NOTHING, 88),
}
CONNECTING: dict[str, Attack] = {
    "TCP out": make_socket(socket.AF_INET, socket.SOCK_STREAM),
    "TCP in": serve,
    "UDP": make_socket(socket.AF_INET, socket.SOCK_DGRAM),
    "IPv6": make_socket(socket.AF_INET6, socket.SOCK_DGRAM),
    "a socket with a path": send(socket.SOCK_STREAM, "/dev/log"),
    "an abstract socket": send(socket.SOCK_STREAM, "\0yamaro"),
    "a pair of sockets": pair,
    "netlink": make_socket(socket.AF_NETLINK, socket.SOCK_RAW, 0),
    "raw packets": make_socket(socket.AF_PACKET, socket.SOCK_RAW, 0),
}
REACHING: dict[str, Attack] = {
    "a signal to the parent": lambda robot: os.kill(os.getppid(), 0),
    "a signal to all": lambda robot: os.kill(-1, 0),
    "a signal to the group": lambda robot: os.kill(0, 0),
    "a signal to itself": lambda robot: os.kill(os.getpid(), signal.SIGSTOP),
    "tgkill": lambda robot: raw("tgkill", os.getppid(), os.getppid(), 0),
    "tkill": lambda robot: raw("tkill", os.getppid(), 0),
    "rt_sigqueueinfo": lambda robot: raw("rt_sigqueueinfo", os.getppid(), 0, NOTHING),
    "signals by a file": own_signals_on_pipe,
    "pidfd_open": lambda robot: os.close(raw("pidfd_open", os.getppid(), 0)),
    "pidfd_getfd": call("pidfd_getfd", 0, 0, 0),
    "ptrace": lambda robot: raw("ptrace", 16, os.getppid(), 0, 0),
    "process_vm_readv": read_parent_memory,
    "the parent's limits": lambda robot: raw("prlimit64", os.getppid(), 7, 0, NOTHING),
    "its own limits": set_limit,
    "its own limits by prlimit64": lambda robot: raw("prlimit64", 0, 7, NOTHING, 0),
    "the parent's priority": lambda robot: os.setpriority(os.PRIO_PROCESS, os.getppid(), 19),
    "input of a terminal": push_terminal_input,
    "a new session": lambda robot: os.setsid(),
    "living on without its parent": call("prctl", 1, 0),
    "another user": lambda robot: os.setuid(12345),
}
KERNEL: dict[str, Attack] = {
    "openat2": open_by_openat2,
    "mount": call("mount", "none", "/mnt", "tmpfs", 0, 0),
    "unshare": call("unshare", 0x10000000),
    "setns": call("setns", 0, 0),
    "chroot": call("chroot", "/"),
    "io_uring": call("io_uring_setup", 1, NOTHING),
    "bpf": call("bpf", 0, NOTHING, 0),
    "keyctl": call("keyctl", 0, -3, 0),
    "userfaultfd": call("userfaultfd", 1),
    "perf_event_open": call("perf_event_open", NOTHING, 0, -1, -1, 0),
    "another filter": call("seccomp", 1, 0, NOTHING),
}
ALL = {
    **{f"read: {name}": attack for name, attack in READING.items()},
    **{f"write: {name}": attack for name, attack in WRITING.items()},
    **{f"start: {name}": attack for name, attack in STARTING.items()},
    **{f"connect: {name}": attack for name, attack in CONNECTING.items()},
    **{f"reach: {name}": attack for name, attack in REACHING.items()},
    **{f"kernel: {name}": attack for name, attack in KERNEL.items()},
}
# Those that anyone may do where no jail is, and that do no harm outside the test's own folder.
HARMLESS = [
    *(f"read: {name}" for name in READING),
    *(f"write: {name}" for name in WRITING if not name.startswith("/")),
    *(f"start: {name}" for name in ("os.fork", "os.system", "subprocess", "posix_spawn")),
    *(f"connect: {name}" for name in ("TCP out", "TCP in", "UDP", "a pair of sockets", "netlink")),
    *(f"reach: a signal to {whom}" for whom in ("the parent", "all", "the group")),
    "reach: pidfd_open",
    "reach: its own limits",
    "reach: living on without its parent",
    "reach: a new session",
]


def outcome_of(attack: Attack, robot: Path) -> bytes:
    """Return whether an attack was refused by the kernel; any other failure is a fault of ours."""
    try:
        attack(robot)
    except OSError as error:
        return errno.errorcode[error.errno or 0].encode()
    return b"it succeeded"


REFUSALS = {b"EPERM", b"EACCES", b"ENOSYS"}


@in_jail
@pytest.mark.parametrize("version", sample(["newest", 1, 3, 4], every=4))
@pytest.mark.parametrize("name", ALL)
def test_an_attack_is_refused_and_leaves_no_trace(
    name: str, version: int | str, robot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if isinstance(version, int):
        monkeypatch.setattr(landlock, "version", lambda: version)
    before = snapshot(robot.parent)
    assert run(lambda: outcome_of(ALL[name], robot), robot) in REFUSALS
    assert snapshot(robot.parent) == before


@pytest.mark.parametrize("name", HARMLESS)
def test_the_attack_would_succeed_outside(name: str, tmp_path: Path) -> None:
    robot = furnish(tmp_path)
    reader, writer = os.pipe()
    pid = os.fork()
    if pid == 0:
        try:
            os.write(writer, outcome_of(ALL[name], robot))
        finally:
            os._exit(0)
    os.close(writer)
    with open(reader, "rb") as file:
        outcome = file.read()
    os.waitpid(pid, 0)
    assert outcome == b"it succeeded"


def no_effect(*_: object) -> None:
    return None


@in_jail
@pytest.mark.parametrize("name", [name for name in ALL if name.startswith(("read", "write"))])
def test_landlock_alone_guards_files(
    name: str, robot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kinds = ("mode", "owner", "time", "locking", "shared memory", "in memory", "truncate")
    if any(kind in name for kind in kinds):
        pytest.skip("Landlock has no say in that")
    monkeypatch.setattr(seccomp, "install", no_effect)
    monkeypatch.setattr(child, "_prove_confined", no_effect)
    before = snapshot(robot.parent)
    assert run(lambda: outcome_of(ALL[name], robot), robot) in {*REFUSALS, b"EXDEV"}
    assert snapshot(robot.parent) == before


@in_jail
@pytest.mark.parametrize("name", [name for name in ALL if not name.startswith("read")])
def test_the_filter_alone_guards_all_but_reading(
    name: str, robot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(landlock, "restrict", no_effect)
    monkeypatch.setattr(child, "_prove_confined", no_effect)
    before = snapshot(robot.parent)
    assert run(lambda: outcome_of(ALL[name], robot), robot) in REFUSALS
    assert snapshot(robot.parent) == before


@in_jail
def test_every_system_call_that_is_not_allowed_is_refused() -> None:
    """Whatever the arguments: these would do no harm if a call came through."""
    allowed = set(calls.here().allowed.values())
    # uretprobe and uprobe of x86-64 pass by every filter, to end whoever calls them unasked
    probes = {335, 336}
    numbers = [number for number in range(600) if number not in allowed | probes]

    def work() -> bytes:
        wrong = []
        for number in numbers:
            result = calls.call(number, *[-1] * 6)
            if result != -1 or ctypes.get_errno() not in (errno.EPERM, errno.ENOSYS):
                wrong.append(number)
        return json.dumps(wrong).encode()

    assert len(numbers) > 450
    assert json.loads(run(work)) == []


@in_jail
@pytest.mark.parametrize("name", sorted(RAW_CALLS))
def test_a_dangerous_call_is_not_in_the_table(name: str) -> None:
    restricted = {"clone", "openat", "prctl", "prlimit64"}
    for column in (0, 1):
        architecture = list(calls.ARCHITECTURES.values())[column]
        number = RAW_CALLS[name][column]
        assert (number in architecture.allowed.values()) == (name in restricted)


# --- limits -----------------------------------------------------------------------------------


def endless() -> bytes:
    while True:
        pass


def sleep() -> bytes:
    time.sleep(100)
    return b"never"


def ignoring_signals() -> bytes:
    signal.signal(signal.SIGXCPU, signal.SIG_IGN)
    return endless()


def start_threads() -> bytes:
    threading.stack_size(32 << 10)
    wait = threading.Event()
    while True:
        try:
            threading.Thread(target=wait.wait, daemon=True).start()
        except RuntimeError:
            time.sleep(0.1)


def pipe() -> int:
    """Return the descriptor through which a jail answers, as an attacker would find it."""
    for descriptor in range(3, 1000):
        try:
            if stat.S_ISFIFO(os.fstat(descriptor).st_mode):
                return descriptor
        except OSError:
            continue
    raise AssertionError("there is no pipe")


def forge(data: bytes, *, then: Callable[[], object] = lambda: os._exit(0)) -> Callable[[], bytes]:
    def work() -> bytes:
        os.write(pipe(), data)
        then()
        return b"never"

    return work


def close_pipe() -> bytes:
    os.close(pipe())
    return sleep()


def segfault() -> bytes:
    return ctypes.string_at(8)


HEADER = protocol.HEADER
ENDINGS: dict[str, tuple[Callable[[], bytes], dict[str, Any], type[jail.JailError], str]] = {
    "an endless loop": (
        endless,
        {"cpu_seconds": 1},
        jail.JailCpuTimeOver,
        "it computes for more than 1 s",
    ),
    "an endless loop that ignores the signal": (
        ignoring_signals,
        {"cpu_seconds": 1},
        jail.JailCpuTimeOver,
        "it computes for more than 1 s",
    ),
    "a number too large to compute": (
        lambda: b"%d" % 10**10**10,
        {"cpu_seconds": 1},
        jail.JailCpuTimeOver,
        "it computes for more than 1 s",
    ),
    "sleeping": (
        sleep,
        {"seconds": 0.25},
        jail.JailTimeOver,
        "it takes longer than 0.25 s",
    ),
    "a long text": (
        lambda: b"a" * 10**11,
        {},
        jail.JailOutOfMemory,
        "the memory does not suffice",
    ),
    "a long text in small pieces": (
        lambda: b"".join(list(iter(lambda: bytes(1 << 20), None))),
        {},
        jail.JailOutOfMemory,
        "the memory does not suffice",
    ),
    "many threads": (
        start_threads,
        {"threads": 50},
        jail.JailTooManyThreads,
        "it runs more than 50 threads",
    ),
    "a huge answer": (
        lambda: bytes(2000),
        {"answer": 1999},
        jail.JailAnswerTooLong,
        "the answer has 2000 bytes",
    ),
    "a length that is a lie": (
        forge(HEADER.pack(protocol.ANSWER, 1 << 60)),
        {},
        jail.JailAnswerTooLong,
        "the answer has 1152921504606846976 bytes",
    ),
    "an answer that ends early": (
        forge(HEADER.pack(protocol.ANSWER, 1000) + b"short"),
        {},
        jail.JailAnswerBroken,
        "the answer was cut short",
    ),
    "an answer that never ends": (
        forge(HEADER.pack(protocol.ANSWER, 1000) + b"short", then=lambda: time.sleep(100)),
        {"seconds": 0.25},
        jail.JailTimeOver,
        "it takes longer than 0.25 s",
    ),
    "half a header": (
        forge(b"A"),
        {},
        jail.JailAnswerBroken,
        "the answer was cut short",
    ),
    "an unknown kind of answer": (
        forge(HEADER.pack(b"?", 0)),
        {},
        jail.JailAnswerBroken,
        "the answer is not valid",
    ),
    "a lie that there is no jail": (
        forge(HEADER.pack(protocol.NO_JAIL, 0)),
        {},
        jail.JailAnswerBroken,
        "the answer is not valid",
    ),
    "leaving": (
        lambda: os._exit(0),  # type: ignore[arg-type, return-value]
        {},
        jail.JailAnswerBroken,
        "the answer was cut short",
    ),
    "closing the pipe": (
        close_pipe,
        {},
        jail.JailAnswerBroken,
        "the answer was cut short",
    ),
    "a segmentation fault": (
        segfault,
        {},
        jail.JailCrashed,
        "it crashed (SIGSEGV)",
    ),
    "SystemExit": (
        lambda: sys.exit("bye"),
        {},
        jail.JailWorkFailed,
        "SystemExit: bye at ",
    ),
    "no bytes": (
        lambda: "text",  # type: ignore[dict-item, return-value]
        {},
        jail.JailWorkFailed,
        "TypeError: the work gives no bytes at ",
    ),
}


@in_jail
@pytest.mark.parametrize("name", ENDINGS)
def test_a_limit_ends_the_work_and_says_which(name: str) -> None:
    work, limits, kind, message = ENDINGS[name]
    with pytest.raises(jail.JailError) as raised:
        run(work, **limits)
    assert type(raised.value) is kind
    assert str(raised.value).startswith(message)


def test_an_error_names_the_limit() -> None:
    kinds = jail.JailError.__subclasses__()
    limits = {kind.limit for kind in kinds if kind.limit}
    assert limits == set(JailLimits.__slots__) - {"open_files", "is_abandoned"}


@in_jail
def test_abort_ends_the_work() -> None:
    with pytest.raises(jail.JailCrashed):
        run(lambda: os.abort())


@in_jail
def test_only_so_many_files_can_be_open(robot: Path) -> None:
    def work() -> bytes:
        held = []
        try:
            while True:
                held.append(os.open(robot / "robot.yaml", os.O_RDONLY))
        except OSError as error:
            return pack([b"%d" % len(held), errno.errorcode[error.errno or 0].encode()])

    count, reason = unpack(run(work, robot, open_files=50))
    assert 40 < int(count) < 50
    assert reason == b"EMFILE"


@in_jail
@pytest.mark.skipif(platform.machine() != "x86_64", reason="x32 is of x86-64")
def test_a_call_of_x32_ends_the_work() -> None:
    with pytest.raises(jail.JailCrashed, match="another architecture"):
        run(lambda: b"%d" % calls.call(0x40000000 + 39))


@in_jail
@pytest.mark.skipif(platform.machine() != "x86_64", reason="machine code of x86-64")
def test_a_32_bit_call_ends_the_work() -> None:
    import mmap

    def work() -> bytes:
        page = mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
        page.write(b"\xb8\x14\x00\x00\x00\xcd\x80\xc3")  # mov eax, 20; int 0x80; ret
        start = ctypes.addressof(ctypes.c_char.from_buffer(page))
        return b"%d" % ctypes.CFUNCTYPE(ctypes.c_int)(start)()

    with pytest.raises(jail.JailCrashed):
        run(work)


# --- what it sees -----------------------------------------------------------------------------


@in_jail
def test_nothing_is_open_but_the_standard_streams_and_the_pipe(robot: Path) -> None:
    def work() -> bytes:
        found = {}
        for descriptor in range(256):
            try:
                found[descriptor] = stat.S_IFMT(os.fstat(descriptor).st_mode)
            except OSError:
                continue
        return json.dumps(sorted(found.values())).encode()

    with open(robot / "robot.yaml"), socket.socket(socket.AF_UNIX):
        kinds = json.loads(run(work))
    assert kinds == sorted([stat.S_IFCHR] * 3 + [stat.S_IFIFO])


@in_jail
def test_the_environment_is_hidden_but_for_a_list(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("YAMARO_SECRET", "swordfish")
    monkeypatch.setenv("ROS_PACKAGE_PATH", "/ws")
    libc = ctypes.CDLL(None)
    libc.getenv.restype = ctypes.c_char_p
    names = ("YAMARO_SECRET", "ROS_PACKAGE_PATH", "PATH", "HOME")

    def work() -> bytes:
        by_python = [os.environ.get(name) for name in names]
        by_c = [(libc.getenv(name.encode()) or b"").decode() or None for name in names]
        return json.dumps([by_python, by_c]).encode()

    assert json.loads(run(work)) == [[None, "/ws", None, None]] * 2
    limits = JailLimits(**USUAL)
    answer = run_jailed(work, readable=[], limits=limits, environment=["YAMARO_SECRET"])
    assert json.loads(answer) == [["swordfish", None, None, None]] * 2


@in_jail
def test_no_mapping_holds_the_environment() -> None:
    program = (
        "import os, posix\nfrom yamaro.sandbox import jail\n"
        "def work():\n"
        "    mappings = (posix.environ, os.environ, os.environb)\n"
        "    text = repr([dict(mapping) for mapping in mappings])\n"
        "    return b'%d' % text.count('swordfish')\n"
        "print(work(), jail.run_jailed(work, readable=[], limits=jail.JailLimits()))\n"
    )
    finished = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        env={**os.environ, "YAMARO_SECRET": "swordfish"},
    )
    assert finished.stdout == "b'3' b'0'\n"


@in_jail
def test_the_text_of_the_environment_is_overwritten(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("YAMARO_SECRET", "swordfish")
    strings = ctypes.POINTER(ctypes.c_void_p).in_dll(ctypes.CDLL(None), "environ")
    index = 0
    while b"YAMARO_SECRET" not in ctypes.string_at(strings[index]):
        index += 1
    place = strings[index]
    assert place is not None
    assert run(lambda: ctypes.string_at(place, 20)) == bytes(20)
    assert ctypes.string_at(place) == b"YAMARO_SECRET=swordfish"


@in_jail
def test_what_it_prints_is_lost(capfd: pytest.CaptureFixture[str]) -> None:
    def work() -> bytes:
        print("to output", flush=True)
        print("to error", file=sys.stderr, flush=True)
        os.write(2, b"\x1b]0;title\x07")
        return b"done"

    assert run(work) == b"done"
    assert capfd.readouterr() == ("", "")


@in_jail
def test_what_was_not_yet_written_is_written_once() -> None:
    program = (
        "import sys\nfrom yamaro.sandbox import jail\n"
        "sys.stdout.write('once ')\n"
        "def work():\n    sys.stdout.flush()\n    sys.__stdout__.flush()\n    return b'done'\n"
        "answer = jail.run_jailed(work, readable=[], limits=jail.JailLimits())\n"
        "print(answer.decode())\n"
    )
    finished = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE
    )
    assert (finished.stdout, finished.stderr) == ("once done\n", "")


@pytest.mark.parametrize("path", ["/", "/proc", "/proc/self", "/sys/kernel", "/dev", "/dev/shm"])
@in_jail
def test_a_folder_that_opens_proc_or_devices_is_refused(path: str) -> None:
    with pytest.raises(jail.JailUnavailable, match=f"'{path}' may not be read in a jail"):
        run(lambda: b"", Path(path))


@in_jail
def test_a_path_that_does_not_exist_is_passed_over(robot: Path) -> None:
    assert run(lambda: b"done", robot / "nothing", robot / "mesh.stl" / "below") == b"done"


@in_jail
def test_a_single_file_can_be_readable(robot: Path) -> None:
    def work() -> bytes:
        read = outcome_of(lambda _: (robot / "mesh.stl").read_bytes(), robot)
        return pack([(robot / "robot.yaml").read_bytes(), read])

    assert unpack(run(work, robot / "robot.yaml")) == [b"robot: {name: r}\n", b"EACCES"]


def test_folders_of_python_are_not_the_folder_of_the_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    packages = tmp_path / "lib" / "site-packages"
    monkeypatch.setattr(sys, "path", ["", str(tmp_path), "relative", str(packages), *sys.path])
    found = jail.python_folders()
    assert str(packages) in found
    assert str(tmp_path) not in found
    assert all(os.path.isabs(path) for path in found)
    assert not [path for path in found if os.path.expanduser("~").startswith(path)]


# --- legal work -------------------------------------------------------------------------------


@in_jail
def test_modules_can_be_imported() -> None:
    program = (
        "from yamaro.sandbox import jail\n"
        "def work():\n"
        "    import math, statistics, json, decimal, random, datetime, csv, fractions, zoneinfo\n"
        "    import colorsys, wave, hashlib, zlib, struct, collections, itertools, unicodedata\n"
        "    assert datetime.datetime.now(datetime.timezone.utc).year > 2000\n"
        "    return json.dumps(statistics.mean([1, math.floor(3.5)])).encode()\n"
        "print(jail.run_jailed(work, readable=[], limits=jail.JailLimits()).decode())\n"
    )
    finished = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE
    )
    assert (finished.stdout, finished.stderr) == ("2\n", "")


@in_jail
def test_numpy_can_be_imported() -> None:
    pytest.importorskip("numpy")
    program = (
        "from yamaro.sandbox import jail\n"
        "def work():\n"
        "    import numpy\n"
        "    return str(numpy.linalg.inv(numpy.eye(300) * 2).sum()).encode()\n"
        "print(jail.run_jailed(work, readable=[], limits=jail.JailLimits()).decode())\n"
    )
    finished = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE
    )
    assert (finished.stdout, finished.stderr) == ("150.0\n", "")


@in_jail
def test_a_robot_is_built_as_outside() -> None:
    from yamaro import convert

    folder = REPOSITORY / "examples"
    main = sorted(folder.glob("*/*.yaml"))[0]
    outside = convert(main)
    assert outside.startswith("<?xml")
    assert run(lambda: convert(main).encode(), folder, memory=3 << 30).decode() == outside


@in_jail
def test_files_can_be_found_and_read(robot: Path) -> None:
    big = robot / "big.stl"
    big.write_bytes(bytes(range(256)) * 100_000)

    def work() -> bytes:
        names = sorted(path.name for path in robot.rglob("*.*"))
        return pack([json.dumps(names).encode(), b"%d" % sum(big.read_bytes()[:256])])

    names, total = unpack(run(work, robot))
    assert json.loads(names) == ["big.stl", "mesh.stl", "robot.yaml"]
    assert total == b"32640"


@in_jail
def test_an_answer_may_be_large() -> None:
    answer = run(lambda: bytes(range(250)) * 120_000, memory=1 << 30)
    assert answer == bytes(range(250)) * 120_000


@in_jail
def test_an_answer_may_be_empty() -> None:
    assert run(lambda: b"") == b""


@in_jail
def test_threads_with_deep_stacks_work() -> None:
    from yamaro.sandbox.deep_stack import run_on_deep_stack

    def depth(n: int) -> int:
        return n if n == 0 else 1 + depth(n - 1)

    def work() -> bytes:
        return b"%d" % run_on_deep_stack(lambda: depth(15_000))

    assert run(work, memory=1 << 30) == b"15000"


@in_jail
def test_time_can_be_told_and_waited_for() -> None:
    def work() -> bytes:
        start = time.perf_counter()
        time.sleep(0.02)
        done = threading.Event()
        threading.Timer(0.02, done.set).start()
        assert done.wait(PATIENCE)
        return b"%d" % (time.perf_counter() - start > 0.03)

    assert run(work) == b"1"


# --- the parent -------------------------------------------------------------------------------


INTERRUPTED = """
import os, signal, time
from yamaro.sandbox import jail

def interrupt(*_):
    raise KeyboardInterrupt

def sleep():
    time.sleep(100)

jail.run_jailed(bytes, readable=[], limits=jail.JailLimits())  # imports what it needs
signal.signal(signal.SIGALRM, interrupt)
files = os.listdir("/proc/self/fd")
interrupted = 0
for moment in [*range(1, 100), 4000]:
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.00005 * moment)
        jail.run_jailed(sleep, readable=[], limits=jail.JailLimits(seconds=500))
    except KeyboardInterrupt:
        interrupted += 1
    assert os.listdir("/proc/self/fd") == files, "a descriptor is left"
    try:
        assert os.waitpid(-1, os.WNOHANG) is None, "a child is left"
    except ChildProcessError:
        pass
print(interrupted)
"""


@in_jail
def test_an_interrupt_at_any_moment_leaves_nothing() -> None:
    # In a process of its own: where Python forks, an interrupt can leave a lock of logging taken,
    # and what measures coverage is left with its lock, too.
    environment = {k: v for k, v in os.environ.items() if not k.startswith("COVERAGE_")}
    command = [sys.executable, "-c", INTERRUPTED]
    finished = subprocess.run(
        command, capture_output=True, text=True, timeout=PATIENCE, env=environment
    )
    assert (finished.stdout, finished.stderr) == ("100\n", "")


@in_jail
def test_signals_have_their_usual_effect_in_the_child() -> None:
    before = signal.signal(signal.SIGUSR1, lambda *_: None)
    signals = (signal.SIGUSR1, signal.SIGPIPE, signal.SIGINT)
    try:
        answer = run(lambda: json.dumps([signal_effect(number) for number in signals]).encode())
    finally:
        signal.signal(signal.SIGUSR1, before)
    default, ignored = 0, 1
    assert json.loads(answer) == [default, default, ignored]
    assert run(lambda: repr(signal.pthread_sigmask(signal.SIG_BLOCK, [])).encode()) == b"set()"


def signal_effect(number: int) -> int | None:
    """Return what the C library says is done about a signal: 0 the default, 1 nothing."""
    old = ctypes.create_string_buffer(256)
    ctypes.CDLL(None).sigaction(number, None, old)
    return int(struct.unpack_from("P", old)[0])


@in_jail
def test_the_child_ends_with_its_parent() -> None:
    program = (
        "import time\nfrom yamaro.sandbox import jail\nprint(flush=True)\n"
        "jail.run_jailed(lambda: time.sleep(100), readable=[], limits=jail.JailLimits())\n"
    )
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE) as process:
        try:
            assert process.stdout is not None
            process.stdout.readline()
            children = wait_for(lambda: children_of(process.pid))
        finally:
            process.kill()
    assert len(children) == 1
    wait_for(lambda: not os.path.exists(f"/proc/{children[0]}"))


def children_of(pid: int) -> list[int]:
    found = []
    for entry in os.listdir("/proc"):
        try:
            fields = Path(f"/proc/{entry}/stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == pid:
            found.append(int(entry))
    return found


@in_jail
def test_a_child_that_someone_kills_is_told_apart() -> None:
    def kill() -> None:
        for pid in wait_for(lambda: children_of(os.getpid())):
            os.kill(pid, signal.SIGKILL)

    killer = threading.Timer(0.2, kill)
    killer.start()
    with pytest.raises(jail.JailCrashed) as raised:
        run(sleep)
    killer.join()
    assert str(raised.value) == "it was killed; perhaps the machine has no memory left"


@in_jail
def test_standard_streams_that_are_missing_or_closed_do_no_harm(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    closed = io.StringIO()
    closed.close()
    monkeypatch.setattr(sys, "stdout", None)
    monkeypatch.setattr(sys, "stderr", closed)
    assert run(lambda: b"done") == b"done"


@in_jail
def test_it_says_that_proc_is_not_mounted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os.path, "exists", lambda path: False)
    assert str(jail.check_available()).startswith("/proc is not mounted")


@in_jail
def test_a_small_pipe_will_do(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(fcntl, "fcntl", refuse)
    assert run(lambda: bytes(1 << 20)) == bytes(1 << 20)


@in_jail
def test_many_threads_can_have_jails_at_once() -> None:
    answers: dict[int, bytes] = {}

    def ask(number: int) -> None:
        answers[number] = run(lambda: b"%d" % (number * number))

    threads = [threading.Thread(target=ask, args=(number,)) for number in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == {number: b"%d" % (number * number) for number in range(12)}


@in_jail
def test_children_that_nobody_waits_for_do_no_harm() -> None:
    before = signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # the kernel reaps them at once
    try:
        assert run(lambda: b"done") == b"done"
        with pytest.raises(jail.JailAnswerBroken):
            run(segfault)
    finally:
        signal.signal(signal.SIGCHLD, before)


@in_jail
def test_descriptors_of_standard_streams_that_are_closed_do_no_harm() -> None:
    program = (
        "import os\nfrom yamaro.sandbox import jail\n"
        "report = os.dup(1)\n"
        "for n in (0, 1, 2): os.close(n)\n"
        "answer = jail.run_jailed(lambda: b'done', readable=[], limits=jail.JailLimits())\n"
        "os.write(report, answer)\n"
    )
    finished = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE
    )
    assert finished.stdout == "done"


STEPS = [
    (child, "_leave_parent"),
    (child, "_replace_standard_streams"),
    (child, "_clear_environment"),
    (child, "_drop_capabilities"),
    (child, "_set_limits"),
    (child, "_close_all_but"),
    (child, "_prove_confined"),
    (landlock, "restrict"),
    (seccomp, "install"),
]


@in_jail
@pytest.mark.parametrize("step", STEPS, ids=lambda step: step[1])
def test_a_step_that_fails_ends_the_child_before_the_work(
    step: tuple[Any, str], robot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise OSError("the kernel is in a bad mood")

    monkeypatch.setattr(*step, fail)
    with pytest.raises(jail.JailUnavailable) as raised:
        run(lambda: b"%d" % (robot / "new").write_text("x"), robot)
    assert str(raised.value) == "the jail could not be set up: the kernel is in a bad mood"
    assert not (robot / "new").exists()


@in_jail
@pytest.mark.parametrize(
    ("step", "message"),
    [
        ((landlock, "restrict"), "Landlock has no effect"),
        ((seccomp, "install"), "the seccomp filter has no effect"),
    ],
)
def test_a_kernel_that_only_pretends_is_found_out(
    step: tuple[Any, str], message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(*step, no_effect)
    with pytest.raises(jail.JailUnavailable, match=message):
        run(lambda: b"")


@in_jail
def test_a_child_that_dies_while_it_is_set_up_is_no_jail(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(seccomp, "install", lambda *_: segfault())
    with pytest.raises(jail.JailUnavailable, match="it crashed"):
        run(lambda: b"")


@pytest.mark.parametrize(
    ("version", "message"),
    [
        (-errno.ENOSYS, "the kernel has no Landlock, which Linux 5.13 brought"),
        (-errno.EOPNOTSUPP, "Landlock is turned off; name it in the kernel's option lsm="),
        (-errno.EPERM, "Landlock is refused here, perhaps by a container: Operation not permitted"),
    ],
)
def test_it_says_why_landlock_is_missing(
    version: int, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(landlock, "version", lambda: version)
    assert jail.check_available() == message
    with pytest.raises(jail.JailUnavailable, match=re.escape(message)):
        run(lambda: b"")


def test_it_says_which_architectures_it_knows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    assert jail.check_available() == "the jail knows x86-64 and aarch64, not riscv64"


def test_it_says_which_system_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "darwin")
    assert jail.check_available() == "the jail needs Linux"


@in_jail
def test_it_says_that_filters_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(seccomp, "why_unavailable", lambda _: errno.EINVAL)
    assert jail.check_available() == "the kernel takes no seccomp filters: Invalid argument"


def test_exceptions_are_described_even_if_their_own_code_fails() -> None:
    class Evil(Exception):
        def __str__(self) -> str:
            raise ValueError

    assert child._describe(Evil()) == ("Evil", "", "", "fault")
    assert child._describe(KeyError("k")) == ("KeyError", "'k'", "", "fault")
    assert child._describe(SystemExit(3)) == ("SystemExit", "3", "", "")
    with pytest.raises(ZeroDivisionError) as raised:
        print(1 / 0)
    place = f"{Path(__file__).name}:{raised.traceback[-1].lineno + 1}"
    kind, text = "ZeroDivisionError", "division by zero"
    assert child._describe(raised.value) == (kind, text, place, "fault")


# --- Landlock's versions and the filter, on paper ---------------------------------------------


@pytest.mark.parametrize(
    ("version", "accesses", "size"),
    [
        *((1, 13, 8), (2, 14, 8), (3, 15, 8), (4, 15, 16), (5, 16, 16)),
        *((6, 16, 24), (7, 16, 24), (8, 16, 24), (9, 17, 24), (99, 17, 24)),
    ],
)
def test_each_version_of_landlock_denies_what_it_can(
    version: int, accesses: int, size: int
) -> None:
    attributes = landlock.ruleset_attributes(version)
    assert len(attributes) == size
    files, *rest = struct.unpack(f"<{size // 8}Q", attributes)
    assert files == 2**accesses - 1
    assert rest == [3] * len(rest)


X86_64 = 0xC000003E
AARCH64 = 0xC00000B7
I386 = 0x40000003
ALLOW, KILL, EPERM, ENOSYS = 0x7FFF0000, 0x80000000, 0x50001, 0x50026
BOTH = [("x86_64", X86_64), ("aarch64", AARCH64)]


def verdict(machine: str, audit: int, number: int, *arguments: int) -> int:
    """Run the filter as the kernel would."""
    program = list(struct.iter_unpack("=HBBI", seccomp.program(calls.ARCHITECTURES[machine])))
    data = struct.pack("<IIQ6Q", number, audit, 0, *arguments, *[0] * (6 - len(arguments)))
    accumulator = index = 0
    while True:
        code, if_true, if_false, value = program[index]
        index += 1
        if code == 0x20:
            (accumulator,) = struct.unpack_from("<I", data, value)
        elif code == 0x54:
            accumulator &= value
        elif code == 0x06:
            return int(value)
        else:
            compare = {0x15: accumulator == value, 0x25: accumulator > value}
            compare[0x35] = accumulator >= value
            index += if_true if compare[code] else if_false


@pytest.mark.parametrize(("machine", "audit"), BOTH)
def test_the_filter_allows_the_table_and_no_more(machine: str, audit: int) -> None:
    allowed = calls.ARCHITECTURES[machine].allowed
    free = {number for name, number in allowed.items() if name not in seccomp._CONDITIONS}
    found = {number for number in range(2000) if verdict(machine, audit, number) == ALLOW}
    # of those with conditions, some allow arguments that are all zero
    with_zeros = {"open", "openat", "fcntl", "futex", "prlimit64"} & set(allowed)
    assert found == free | {allowed[name] for name in with_zeros}
    assert {verdict(machine, audit, n) for n in range(447)} == {ALLOW, EPERM, ENOSYS}
    assert {verdict(machine, audit, n) for n in range(447, 2000)} == {ENOSYS}


@pytest.mark.parametrize(("machine", "audit"), BOTH)
def test_the_filter_judges_arguments(machine: str, audit: int) -> None:
    numbers = calls.ARCHITECTURES[machine].allowed

    def judge(name: str, *arguments: int) -> int:
        return verdict(machine, audit, numbers[name], *arguments)

    glibc_thread, musl_thread = 0x3D0F00, 0x7D0F00
    assert judge("clone", glibc_thread) == ALLOW
    assert judge("clone", musl_thread) == ALLOW
    for flags in (17, 0, 0x01200011, 0x4111, glibc_thread | 0x10000000, glibc_thread | 0x8000):
        assert judge("clone", flags) == EPERM
    for bit in range(32):
        if not (1 << bit) & (musl_thread | 0x1000000):
            assert judge("clone", glibc_thread | 1 << bit) == EPERM
    reading = os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK | os.O_DIRECTORY | os.O_NOFOLLOW
    assert judge("openat", 5, 5, reading) == ALLOW
    for flag in (1, 2, 3, 0o100, 0o1000, 0o2000, 0o20200000, 0o10000000):
        assert judge("openat", 5, 5, reading | flag) == EPERM
    assert judge("prlimit64", 0, 7, 0, 99) == ALLOW
    for arguments in ((1, 7, 0, 99), (0, 7, 99, 0), (0, 7, 99 << 32, 0)):
        assert judge("prlimit64", *arguments) == EPERM
    assert {judge("ioctl", 0, c) for c in (0x5401, 0x5413, 0x5451, 0x5450)} == {ALLOW}
    assert {judge("ioctl", 0, c) for c in (0, 0x5412, 0x541C, 0x5402)} == {EPERM}
    assert {judge("fcntl", 3, c) for c in (0, 1, 2, 3, 1030)} == {ALLOW}
    assert {judge("fcntl", 3, c) for c in (4, 6, 7, 8, 10, 15, 1024, 1026, 1033)} == {EPERM}
    assert {judge("prctl", c) for c in (15, 16)} == {ALLOW}
    assert {judge("prctl", c) for c in (1, 4, 8, 22, 23, 38, 47, 0x59616D61)} == {EPERM}
    assert {judge("futex", 0, c) for c in (0, 1, 128, 129, 137, 0x189)} == {ALLOW}
    assert {judge("futex", 0, c) for c in (6, 7, 8, 11, 12, 13, 134)} == {EPERM}


@pytest.mark.parametrize(("machine", "audit"), BOTH)
def test_the_filter_kills_for_calls_of_another_architecture(machine: str, audit: int) -> None:
    for other in {X86_64, AARCH64, I386, 0} - {audit}:
        assert {verdict(machine, other, number) for number in range(0, 600, 7)} == {KILL}
    is_x86 = machine == "x86_64"
    assert verdict(machine, audit, 0x40000000 + 39) == (KILL if is_x86 else ENOSYS)
    assert verdict(machine, audit, 0x40000000 + 520) == (KILL if is_x86 else ENOSYS)


def numbers_in(*headers: str) -> dict[str, int]:
    """Return the system calls that the kernel's headers define."""
    definitions: dict[str, str] = {}
    for header in headers:
        path = Path("/usr/include") / header
        if not path.exists():
            pytest.skip(f"there is no {path}")
        definitions.update(re.findall(r"#define (__NR\w+)\s+(\w+)", path.read_text()))
    found = {}
    for name, value in definitions.items():
        while value in definitions:
            value = definitions[value]
        if name.startswith("__NR_") and value.isdigit():
            found[name[5:]] = int(value)
    return found


@pytest.mark.parametrize(
    ("column", "header"),
    [(1, "x86_64-linux-gnu/asm/unistd_64.h"), (2, "asm-generic/unistd.h")],
)
def test_the_numbers_are_those_of_the_kernel(column: int, header: str) -> None:
    known = numbers_in(header)
    for table in (calls.ALLOWED_CALLS, calls.SETUP_CALLS):
        for name, number in calls.numbers(table, column).items():
            assert (name, known[name]) == (name, number)
    for name, both in RAW_CALLS.items():
        assert (name, known.get(name)) == (name, both[column - 1])


# --- packing ----------------------------------------------------------------------------------


@given(st.lists(st.binary()))
def test_what_is_packed_is_unpacked(parts: list[bytes]) -> None:
    assert unpack(pack(parts)) == parts


@given(st.binary())
def test_what_can_be_unpacked_was_packed(data: bytes) -> None:
    try:
        parts = unpack(data)
    except jail.JailAnswerBroken:
        return
    assert pack(parts) == data


@given(st.lists(st.binary(), min_size=1), st.data())
def test_what_is_cut_is_noticed(parts: list[bytes], data: st.DataObject) -> None:
    packed = pack(parts)
    ends = {len(pack(parts[:count])) for count in range(len(parts) + 1)}
    cut = data.draw(st.integers(0, len(packed) - 1).filter(lambda end: end not in ends))
    with pytest.raises(jail.JailAnswerBroken):
        unpack(packed[:cut])


def test_a_part_longer_than_the_answer_is_noticed() -> None:
    with pytest.raises(jail.JailAnswerBroken, match="longer than the answer"):
        unpack(struct.pack("<Q", (1 << 64) - 1) + b"x")
    with pytest.raises(jail.JailAnswerBroken, match="ends within a length"):
        unpack(b"\x00")


@in_jail
def test_work_that_nobody_wants_any_more_is_ended() -> None:
    asked = iter([False, False, True])
    limits = jail.JailLimits(is_abandoned=lambda: next(asked))
    with pytest.raises(jail.JailAbandoned):
        jail.run_jailed(sleep, readable=(), limits=limits)  # of which no child is left: see above
