"""Plays the same robots in MuJoCo, Drake and Newton, from the MJCF, SDF and USD that Yamaro writes.

    NEWTON=/path/to/python python bench/play.py FILE... [--only NAMES] [--seconds S] [--meshes]
                                                [--no-contacts] [--joints] [--packages FOLDER]

NEWTON is the Python of an environment with `newton[sim]`; without it, two simulators play. FILE is
a robot in YAML, URDF or xacro. One without actuators, or with efforts alone, gets a position
actuator in each joint, whose gains Yamaro chooses. Roots are fixed in the world.

Each robot is held in its state `home` for ten seconds, or at 0: the table says how far a joint is
from there at most. Then the target of each joint in turn is moved by 0.1 rad, or by 0.01 m, and of
those that are driven by velocity by 0.1 rad/s or m/s. The table says by how much the positions of
any joint differ between two simulators, over 0.3 s. Numbers beyond the bars, which are
1e-3 rad and 0.03 rad, have a `*`. `--joints` names the joint that is the worst.

For a difference beyond the bar, the worst response is played again without what the simulators are
known to treat otherwise, and the table says with which of these the difference is gone, and what is
left: without the gaps of 0.1 m from which Newton lets contacts act on what approaches, without
contacts, without Coulomb friction of joints, which Drake does not have, with
equalities (joints that follow) that MuJoCo and Newton hold ten times as stiffly, and with efforts
limited in actuators and not only in joints: there `implicitfast` counts the damping of a drive also
while it is at its limit, which slows the joint down by the step of time.

All three integrate to the first order, and implicitly in what damps a joint: MuJoCo and Newton
with `implicitfast`, Drake in discrete steps with SAP. Holding takes steps of 2 ms, and responses
of 0.04 ms, so that the integrators differ by less than the bar. Newton is `SolverMuJoCo` on the
processor: it holds with all that Newton does between steps. For the responses, MuJoCo steps the
model that this solver made of Newton's, which is the same and faster.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import numpy as np  # noqa: E402 - after the path

Positions = dict[str, list[float]]
"""Of each joint by its name, at times that are evenly spaced."""
HOLD_STEP, HOLD_SECONDS = 2e-3, 10.0
RESPONSE_STEP, RESPONSE_SECONDS = 4e-5, 0.3
SAMPLES = 100
RESPONSE_BAR, DRIFT_BAR = 1e-3, 0.03
JUMP = {"revolute": 0.1, "continuous": 0.1, "prismatic": 0.01}
NAMES = ("MuJoCo", "Drake", "Newton")
PAIRS = ((0, 1), (0, 2), (1, 2))
CAUSES = ("gaps", "contacts", "friction", "soft equalities", "limits at joints")
STIFF = (4e-4, 1.0)
"""MuJoCo's `solref`: ten times as stiff as what Yamaro writes."""


class Job:
    """What is played.

    Attributes:
        path: the model.
        home: where each joint starts, by its name.
        commands: `position` or `velocity` for each joint that is driven.
        targets: for each response, the joint that is moved and its target.
        names: what the model calls each joint.
        seconds: how long the robot is held.
        without: what is left out of the models, of `CAUSES`.
    """

    def __init__(self, **values: Any) -> None:
        self.path: str = values["path"]
        self.home: dict[str, float] = values["home"]
        self.commands: dict[str, str] = values["commands"]
        self.targets: dict[str, float] = values["targets"]
        self.names: dict[str, str] = values["names"]
        self.seconds: float = values["seconds"]
        self.without: list[str] = values["without"]

    def command(self, joint: str) -> float:
        """Return what an actuator is commanded at first."""
        return self.home[joint] if self.commands[joint] == "position" else 0.0


class Played:
    """What a simulator gave.

    Attributes:
        hold: the positions while the robot is held.
        responses: those after each target was moved.
        error: what went wrong, or "".
    """

    def __init__(
        self, hold: Positions, responses: dict[str, Positions], *, error: str = ""
    ) -> None:
        self.hold = hold
        self.responses = responses
        self.error = error


# --- MuJoCo ---------------------------------------------------------------------------------------


class Mujoco:
    """A model of MuJoCo that plays."""

    def __init__(self, model: Any, job: Job) -> None:
        self.mujoco = import_module("mujoco")
        self.model, self.job = model, job
        self.data = self.mujoco.MjData(model)
        self.joints = {name: model.joint(own).id for name, own in job.names.items()}
        self.places = {name: model.jnt_qposadr[joint] for name, joint in self.joints.items()}
        drives = {int(model.actuator_trnid[index, 0]): index for index in range(model.nu)}
        self.drives = {name: drives[self.joints[name]] for name in job.commands}
        if "gaps" in job.without:
            model.geom_gap[:] = 0
        if "contacts" in job.without:
            model.opt.disableflags |= self.mujoco.mjtDisableBit.mjDSBL_CONTACT
        if "friction" in job.without:
            model.dof_frictionloss[:] = 0
        if "limits at joints" in job.without:
            joints = model.actuator_trnid[:, 0]
            model.actuator_forcelimited[:] = model.jnt_actfrclimited[joints]
            model.actuator_forcerange[:] = model.jnt_actfrcrange[joints]
        if "soft equalities" in job.without:
            model.eq_solref[:] = STIFF

    def start(self) -> None:
        self.mujoco.mj_resetData(self.model, self.data)
        for name, place in self.places.items():
            self.data.qpos[place] = self.job.home[name]
        for name, index in self.drives.items():
            self.data.ctrl[index] = self.job.command(name)

    def run(self, seconds: float, step: float) -> Positions:
        self.model.opt.timestep = step
        count = round(seconds / step / SAMPLES)
        found: Positions = {name: [] for name in self.places}
        for _ in range(SAMPLES):
            self.mujoco.mj_step(self.model, self.data, count)
            for name, place in self.places.items():
                found[name].append(float(self.data.qpos[place]))
        return found

    def responses(self) -> dict[str, Positions]:
        found = {}
        for joint, target in self.job.targets.items():
            self.start()
            self.data.ctrl[self.drives[joint]] = target
            found[joint] = self.run(RESPONSE_SECONDS, RESPONSE_STEP)
        return found


def play_mujoco(job: Job) -> Played:
    mujoco = import_module("mujoco")
    player = Mujoco(mujoco.MjModel.from_xml_path(job.path), job)
    player.start()
    hold = player.run(job.seconds, HOLD_STEP) if job.seconds else {}
    return Played(hold, player.responses())


# --- Drake ----------------------------------------------------------------------------------------


class Drake:
    """A plant of Drake that plays."""

    def __init__(self, job: Job, step: float) -> None:
        parsing = import_module("pydrake.multibody.parsing")
        plants = import_module("pydrake.multibody.plant")
        framework = import_module("pydrake.systems.framework")
        builder = framework.DiagramBuilder()
        if "contacts" not in job.without:
            self.plant, _ = plants.AddMultibodyPlantSceneGraph(builder, step)
        else:
            self.plant = builder.AddSystem(plants.MultibodyPlant(step))
        self.plant.set_discrete_contact_approximation(plants.DiscreteContactApproximation.kSap)
        (self.robot,) = parsing.Parser(self.plant).AddModels(job.path)
        self.plant.Finalize()
        self.diagram = builder.Build()
        self.job = job
        own = {name: self.plant.GetJointByName(called) for name, called in job.names.items()}
        self.joints = own
        self.order = [
            self.plant.get_joint_actuator(index).joint().name()
            for index in self.plant.GetJointActuatorIndices(self.robot)
        ]

    def start(self, target: dict[str, float]) -> Any:
        simulator = import_module("pydrake.systems.analysis").Simulator(self.diagram)
        context = self.plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
        for name, joint in self.joints.items():
            self.plant.SetPositions(context, self._row(joint, self.job.home[name], context))
        positions, velocities = [0.0] * len(self.order), [0.0] * len(self.order)
        called = {own: name for name, own in self.job.names.items()}
        for index, own in enumerate(self.order):
            name = called.get(own, "")
            if name in self.job.commands:
                value = target.get(name, self.job.command(name))
                rows = positions if self.job.commands[name] == "position" else velocities
                rows[index] = value
        self.plant.get_desired_state_input_port(self.robot).FixValue(
            context, np.array(positions + velocities)
        )
        simulator.Initialize()
        return simulator

    def _row(self, joint: Any, value: float, context: Any) -> Any:
        positions = self.plant.GetPositions(context)
        positions[joint.position_start()] = value
        return positions

    def run(self, target: dict[str, float], seconds: float) -> Positions:
        simulator = self.start(target)
        found: Positions = {name: [] for name in self.joints}
        for index in range(1, SAMPLES + 1):
            simulator.AdvanceTo(seconds * index / SAMPLES)
            context = self.plant.GetMyContextFromRoot(simulator.get_context())
            positions = self.plant.GetPositions(context)
            for name, joint in self.joints.items():
                found[name].append(float(positions[joint.position_start()]))
        return found


def play_drake(job: Job) -> Played:
    hold = Drake(job, HOLD_STEP).run({}, job.seconds) if job.seconds else {}
    fast = Drake(job, RESPONSE_STEP)
    steps = {
        joint: fast.run({joint: target}, RESPONSE_SECONDS) for joint, target in job.targets.items()
    }
    return Played(hold, steps)


# --- Newton ---------------------------------------------------------------------------------------


def play_newton(job: Job) -> Played:
    """Play in Newton, of which this Python has the packages."""
    newton = import_module("newton")
    builder = newton.ModelBuilder()
    newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
    builder.add_usd(job.path)
    model = builder.finalize(device="cpu")
    solver = newton.solvers.SolverMuJoCo(
        model,
        use_mujoco_cpu=True,
        integrator="implicitfast",
        disable_contacts="contacts" in job.without,
    )
    coordinates = [*map(int, model.joint_q_start.numpy())]
    labels = {label.rpartition("/")[2]: index for index, label in enumerate(model.joint_label)}
    numbers = {name: labels[own] for name, own in job.names.items()}
    one, other, control = model.state(), model.state(), model.control()
    positions = one.joint_q.numpy()
    targets, speeds = control.joint_target_q.numpy(), control.joint_target_qd.numpy()
    for name, number in numbers.items():
        positions[coordinates[number]] = job.home[name]
        if job.commands.get(name) == "position":
            targets[coordinates[number]] = job.home[name]
    for array, values in ((one.joint_q, positions), (control.joint_target_q, targets),
                          (control.joint_target_qd, speeds)):  # fmt: skip
        array.assign(values)
    newton.eval_fk(model, one.joint_q, one.joint_qd, one)
    count = round(job.seconds / HOLD_STEP)
    hold: Positions = {name: [] for name in numbers}
    for index in range(1, count + 1):
        one.clear_forces()
        solver.step(one, other, control, None, HOLD_STEP)
        one, other = other, one
        if index % (count // SAMPLES) == 0:
            positions = one.joint_q.numpy()
            for name, number in numbers.items():
                hold[name].append(float(positions[coordinates[number]]))
    made = solver.mj_model
    inside = [made.joint(index).name for index in range(made.njnt)]
    for name, number in numbers.items():
        job.names[name] = next(
            each for each in inside if each == model.joint_label[number].replace("/", "_")
        )
    return Played(hold, Mujoco(made, job).responses())


class Newton:
    """A process with Newton."""

    def __init__(self, python: str) -> None:
        self._process = subprocess.Popen(
            [python, __file__, "--newton"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        )  # fmt: skip

    def __call__(self, job: Job) -> Played:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(vars(job)) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        if not line:
            return Played({}, {}, error=f"Newton ended with {self._process.wait()}")
        return Played(**json.loads(line))


def answer_as_newton() -> None:
    """Answer jobs on standard input, a line of JSON each."""
    import_module("warp").config.quiet = True
    answers, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        try:
            played = play_newton(Job(**json.loads(line)))
        except Exception as error:
            played = Played({}, {}, error=fault(error))
        print(json.dumps(vars(played)), file=answers, flush=True)


def fault(error: Exception) -> str:
    """Return an error in a line."""
    lines = str(error).splitlines() or [""]
    return f"{type(error).__name__}: {lines[0][:200]}"


# --- robots ---------------------------------------------------------------------------------------


class Robot:
    """A robot in three formats, and what is to be played with it."""

    def __init__(self, path: Path, folder: Path, given: argparse.Namespace) -> None:
        import yamaro
        from tests.targets.standing import with_position_actuators
        from yamaro.model.kinematics import joint_positions
        from yamaro.model.positions import home_positions

        packages = {each.name: each for root in given.packages for each in Path(root).iterdir()}
        options: dict[str, Any] = {"packages": packages, "repair_inertia": True}
        build = yamaro.build(path, **options)
        if all(each.command == "effort" for each in build.robot.actuators.values()):
            path_of_urdf = folder / "robot.urdf"
            path_of_urdf.write_text(with_position_actuators(build.xml()), encoding="utf-8")
            build = yamaro.build(path_of_urdf, **options)
            path = path_of_urdf
        options |= {"base": "fixed", "meshes": "copy" if given.meshes else "none"}
        self.name = build.robot.name or path.stem
        self.files = {}
        for target, ending in (("mjcf", ".xml"), ("sdf", ".sdf"), ("usd", ".usda")):
            made = yamaro.build(path, target=target, **options)
            self.files[target] = folder / target / f"robot{ending}"
            self.files[target].parent.mkdir()
            self.files[target].write_text(made.xml(), encoding="utf-8")
            for name, content in made.assets.items():
                (self.files[target].parent / name).parent.mkdir(exist_ok=True)
                (self.files[target].parent / name).write_bytes(content)
        robot = made.robot
        single = {
            joint.name: joint
            for joint in robot.joints.values()
            if joint.type in JUMP and robot.parent_joint(joint.child) is joint
        }
        positions = joint_positions(robot, home_positions(robot))
        home = {name: float(positions[name]) for name in single}  # type: ignore[arg-type]
        commands = {
            name: actuator.command
            for name, actuator in robot.actuators.items()
            if name in single and single[name].mimic is None and actuator.command != "effort"
        }
        targets = {}
        for name, command in commands.items():
            jump, joint = JUMP[single[name].type], single[name]
            if command == "velocity":
                targets[name] = 0.1
            elif joint.upper is not None and home[name] + jump > joint.upper:
                targets[name] = home[name] - jump
            else:
                targets[name] = home[name] + jump
        self.job = {
            "home": home,
            "commands": commands,
            "targets": targets,
            "seconds": given.seconds,
            "without": ["contacts"] if given.no_contacts else [],
        }

    def played(
        self, newton: Newton | None, only: Sequence[str], **changes: Any
    ) -> dict[str, Played]:
        """Return what each simulator gave, with some changes of the job."""
        found = {}
        for name, target, play in (
            ("MuJoCo", "mjcf", play_mujoco),
            ("Drake", "sdf", play_drake),
            ("Newton", "usd", newton),
        ):
            if play is None or name not in only:
                continue
            names = {
                joint: in_usd(joint) if name == "Newton" else joint for joint in self.job["home"]
            }
            job = Job(path=str(self.files[target]), names=names, **{**self.job, **changes})
            try:
                found[name] = play(job)
            except Exception as error:
                found[name] = Played({}, {}, error=fault(error))
        return found


def in_usd(name: str) -> str:
    """Return what a joint is called in USD, which takes letters, digits and underscores."""
    made = "".join(each if each.isalnum() and each.isascii() else "_" for each in name)
    return f"_{made}" if made[:1].isdigit() else made


def drift(played: Played, job: dict[str, Any]) -> tuple[float, str]:
    """Return how far a joint was from home, and which joint."""
    found = {
        name: max(abs(each - job["home"][name]) for each in played.hold[name])
        for name, command in job["commands"].items()
        if command == "position"
    }
    worst = max(found, key=found.__getitem__, default="")
    return found.get(worst, 0.0), worst


def difference(one: Played, other: Played) -> tuple[float, str]:
    """Return how much two simulators differ, and which response of which joint that is."""
    found = {
        f"{joint} after {moved}": float(np.max(np.abs(np.subtract(row, theirs[joint]))))
        for moved, rows in one.responses.items()
        for theirs in [other.responses[moved]]
        for joint, row in rows.items()
    }
    worst = max(found, key=found.__getitem__, default="")
    return found.get(worst, 0.0), worst


def cause(robot: Robot, newton: Newton | None, pair: Sequence[str], moved: str) -> str:
    """Return without what two simulators agree on a response, and by how much then, or ""."""
    target = {moved: robot.job["targets"][moved]}
    found = ""
    for without in (*((each,) for each in CAUSES), CAUSES):
        again = robot.played(newton, pair, targets=target, seconds=0.0, without=list(without))
        if any(each.error for each in again.values()):
            continue
        value, _ = difference(*again.values())
        found = f" ({value:.1e} without {', '.join(without)})"
        if value <= RESPONSE_BAR:
            break
    return found


def shown(value: float, bar: float) -> str:
    """Return a number of the table."""
    return f"{value:.1e}" + ("*" if not value <= bar else "")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--newton", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--only", default=",".join(NAMES))
    parser.add_argument("--seconds", type=float, default=HOLD_SECONDS)
    parser.add_argument("--no-contacts", action="store_true")
    parser.add_argument("--meshes", action="store_true")
    parser.add_argument("--joints", action="store_true")
    parser.add_argument("--keep", type=Path, help="where models are kept")
    parser.add_argument("--packages", action="append", default=[])
    given = parser.parse_args()
    if given.newton:
        answer_as_newton()
        return
    python = os.environ.get("NEWTON")
    newton = Newton(python) if python and "Newton" in given.only else None
    print("| robot | joints | " + " | ".join(f"{NAMES[i]}–{NAMES[j]}" for i, j in PAIRS)
          + " | " + " | ".join(f"drift in {name}" for name in NAMES) + " |")  # fmt: skip
    print("|---|--:|" + "--:|" * 6)
    for path in given.files:
        with tempfile.TemporaryDirectory() as temporary:
            folder = given.keep / path.stem if given.keep else Path(temporary)
            folder.mkdir(parents=True, exist_ok=True)
            try:
                robot = Robot(path, folder, given)
            except Exception as error:
                print(f"| {path.stem} | {fault(error)} |", flush=True)
                continue
            played = robot.played(newton, given.only.split(","))
            report(robot, played, newton, has_joints=given.joints)


def report(
    robot: Robot, played: dict[str, Played], newton: Newton | None, *, has_joints: bool
) -> None:
    """Print a line of the table, and what is to be said of it."""
    errors = [f"{name}: {each.error}" for name, each in played.items() if each.error]
    good = {name: each for name, each in played.items() if not each.error}
    cells, worst = [], []
    for i, j in PAIRS:
        both = [good.get(NAMES[index]) for index in (i, j)]
        if both[0] is None or both[1] is None:
            cells.append("")
            continue
        value, joint = difference(both[0], both[1])
        reason = ""
        if not value <= RESPONSE_BAR:
            pair = (NAMES[i], NAMES[j])
            reason = cause(robot, newton, pair, joint.rpartition(" after ")[2])
        cells.append(shown(value, RESPONSE_BAR) + reason)
        worst.append(f"{NAMES[i]}–{NAMES[j]}: {joint}")
    for name in NAMES:
        value, joint = drift(good[name], robot.job) if name in good else (0.0, "")
        cells.append(shown(value, DRIFT_BAR) if name in good else "")
        worst.append(f"{name}: {joint}")
    row = f"| {robot.name} | {len(robot.job['targets'])} | "
    print(row + " | ".join(cells) + " |", flush=True)
    for each in (*errors, *(worst if has_joints else ())):
        print(f"  {each}", flush=True)


if __name__ == "__main__":
    main()
