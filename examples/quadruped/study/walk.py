"""Lets a quadruped trot in MuJoCo, and works out what that costs.

`score` gets each variant of the study on a floor. The feet follow paths that depend on the time
alone, the motors are position controllers, and nothing is fed back from the trunk. The robot tries
to go at `SPEED` with each of the step frequencies; the one that costs the least counts.

Sums are those of `fsum`, which are exact. The last digits of numpy's depend on where in memory the
numbers are, and a walk makes much of the last digits.
"""

from math import fsum

import mujoco
import numpy as np
from mujoco import rollout

UNITS = {"leg_length": "m", "frequency": "Hz", "speed": "m/s", "tilt": "rad"}

LEGS = ("front_left", "front_right", "rear_left", "rear_right")
PHASES = np.array([0.0, 0.5, 0.5, 0.0])  # of the legs: a trot, diagonal pairs in turn
SIDES = np.array([1.0, -1.0, 1.0, -1.0])

SPEED = 0.5  # m/s that is asked for
FREQUENCIES = (1.25, 1.5, 1.8, 2.15, 2.6, 3.1, 3.7)  # steps of one leg per second
DUTY = 0.6  # the part of a step in which a foot is on the ground
HEIGHT = 0.75  # of the hips above the feet, in lengths of the straight leg
LIFT = 0.15  # of the feet, in the same unit

STIFFNESS = 1100.0  # of the joints, in N·m/rad for a leg of 1 m: equally stiff at the foot
DAMPING = 0.02  # s, in stiffnesses
LOSS = 0.5  # W/(N·m)²: the heat of a motor that holds 1 N·m

START = 1.5  # s until the gait is steady
MEASURED = 3.0  # s after that, about


def score(scene):
    """Return what walking costs, at the best step frequency."""
    legs = Legs(scene)
    walks = [Walk(legs, frequency) for frequency in FREQUENCIES]
    good = [walk for walk in walks if walk.is_good]
    if not good:
        return {"leg_length": legs.length, "walks": False}
    best = min(good, key=lambda walk: walk.cost)
    return {
        "leg_length": legs.length,
        "walks": True,
        "cost_of_transport": best.cost,
        "work": best.work,
        "heat": best.heat,
        "frequency": best.frequency,
        "speed": best.speed,
        "tilt": best.tilt,
    }


class Legs:
    """The legs of a model, and its motors."""

    def __init__(self, model):
        self.model = model
        motors = [[f"{leg}_{joint}_joint" for joint in ("hip", "thigh", "calf")] for leg in LEGS]
        self.motors = np.array([[model.actuator(name).id for name in row] for row in motors])
        joints = model.actuator_trnid[self.motors, 0]
        self.positions = model.jnt_qposadr[joints]
        self.speeds = model.jnt_dofadr[joints]
        self.upper = -model.body("front_left_calf_link").pos[2]
        self.lower = -model.body("front_left_foot_link").pos[2]
        self.aside = model.body("front_left_thigh_link").pos[1]
        self.length = self.upper + self.lower
        self.weight = fsum(model.body_mass) * -model.opt.gravity[2]
        self.stiffness = STIFFNESS * self.length**2
        model.actuator_gainprm[:, 0] = self.stiffness
        model.actuator_biasprm[:, 1] = -self.stiffness
        model.actuator_biasprm[:, 2] = -self.stiffness * DAMPING

    def angles(self, x, z):
        """Return the angles of thighs and calves for feet at x and z from the hips."""
        cosine = (x**2 + z**2 - self.upper**2 - self.lower**2) / (2 * self.upper * self.lower)
        calf = -np.arccos(np.clip(cosine, -1, 1))
        inner = np.arctan2(self.lower * np.sin(calf), self.upper + self.lower * np.cos(calf))
        return np.arctan2(-x, -z) - inner, calf

    def commands(self, frequency, times):
        """Return the positions asked of the motors, times × legs × joints.

        They are those of the paths, and as far beyond as the weight bends the controllers back.
        """
        phases = (times[:, None] * frequency + PHASES) % 1
        stands = phases < DUTY
        part = np.where(stands, phases / DUTY, (phases - DUTY) / (1 - DUTY))
        step = SPEED * DUTY / frequency
        swing = part - np.sin(2 * np.pi * part) / (2 * np.pi)
        begun = np.minimum(times, 1.0)[:, None]
        x = begun * step * np.where(stands, 0.5 - part, swing - 0.5)
        up = np.where(stands, 0, LIFT * self.length * (1 - np.cos(2 * np.pi * part)) / 2)
        thigh, calf = self.angles(x, begun * up - HEIGHT * self.length)
        load = stands * self.weight / np.maximum(stands.sum(axis=1, keepdims=True), 1)
        knee = -self.upper * np.sin(thigh)
        torques = np.stack([-SIDES * self.aside * load, x * load, (x - knee) * load], axis=2)
        asked = np.stack([0 * thigh, thigh, calf], axis=2) + torques / self.stiffness
        low, high = np.moveaxis(self.model.actuator_ctrlrange[self.motors], 2, 0)
        return np.clip(asked, low, high)


class Walk:
    """A walk with one step frequency.

    Attributes:
        is_good: whether it neither falls nor stays behind.
        work, heat: of the motors, in weights of the robot times the way: mechanical work, which is
            not recovered where the load drives the motor, and losses.
        cost: the sum, the cost of transport.
        speed: in m/s.
        tilt: the greatest tilt of the trunk, in rad.
    """

    def __init__(self, legs, frequency):
        model = legs.model
        self.frequency = frequency
        dt = model.opt.timestep
        first = round(START / dt)
        count = first + round(round(MEASURED * frequency) / frequency / dt)
        asked = legs.commands(frequency, np.arange(count) * dt)
        controls = np.zeros((count, model.nu))
        controls[:, legs.motors.ravel()] = asked.reshape(count, -1)

        start = _standing(legs)
        states, _ = rollout.rollout(model, mujoco.MjData(model), start[None], controls[None])
        qpos = states[0, first - 1 : -1, 1 : 1 + model.nq]
        qvel = states[0, first - 1 : -1, 1 + model.nq :]
        speeds = qvel[:, legs.speeds]
        torques = legs.stiffness * (asked[first:] - qpos[:, legs.positions] - DAMPING * speeds)
        limits = model.actuator_forcerange[legs.motors]
        torques = np.clip(torques, limits[..., 0], limits[..., 1])

        way = np.hypot(*(qpos[-1, :2] - qpos[0, :2]))
        scale = legs.weight * max(way, 1e-9) / dt
        self.work = fsum(np.maximum(torques * speeds, 0).ravel()) / scale
        self.heat = LOSS * fsum((torques**2).ravel()) / scale
        self.cost = self.work + self.heat
        self.speed = (qpos[-1, 0] - qpos[0, 0]) / (len(qpos) * dt)
        upright = 1 - 2 * (qpos[:, 4] ** 2 + qpos[:, 5] ** 2)
        self.tilt = np.arccos(np.clip(upright, -1, 1)).max()
        self.is_good = bool(self.tilt < 0.5 and self.speed > SPEED / 2)


def _standing(legs):
    """Return the state in which the robot stands on its feet."""
    model, data = legs.model, mujoco.MjData(legs.model)
    data.qpos[legs.positions] = legs.commands(1.0, np.zeros(1))[0]
    mujoco.mj_forward(model, data)
    foot = model.geom("front_left_foot_collision")
    floor = model.geom("floor").pos[2]
    data.qpos[2] -= data.geom_xpos[foot.id, 2] - foot.size[0] - floor
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    return state
