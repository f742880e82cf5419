"""Whether two models in MJCF are the same to MuJoCo: compiled both, compared by name.

Things without a name are compared by their order, as the copy may name them. At random states,
which both get by the names of joints, MuJoCo works out the mass matrix, bias, passive and actuator
forces, poses of sites, and what sensors measure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from tests.later import Later

if TYPE_CHECKING:
    import mujoco
else:
    mujoco = Later("mujoco")

if TYPE_CHECKING:
    from collections.abc import Iterator

    Array = np.ndarray[Any, Any]

STATES = 20
TOLERANCE = 1e-9
"""How far numbers may be off, as part of the greatest of their kind."""
NOISE = 100.0
"""How many times as far sensors may be off as a rounding of the positions moves them."""
ROUNDING = 1e-15
SAME_PLACE = 1e-11
"""In m, and of directions: how far the places of shapes may be off that are the same."""
FULL = slice(1, 3)
"""Which warnings are those of more contacts, or constraints, than a model has memory for."""
NO_CONTACTS = 1 << 4
"""mjDSBL_CONTACT."""
CROWD = 1000
"""How many speeds a model has whose bodies, placed at random, would all touch one another."""
ROUNDED = ("body_pos", "body_quat", "geom_pos", "geom_quat")
WIDTHS = {0: (7, 6), 1: (4, 3), 2: (1, 1), 3: (1, 1)}
"""How many numbers of qpos and qvel a joint of each type has."""
KINDS = {
    "body": (mujoco.mjtObj.mjOBJ_BODY, "nbody"),
    "joint": (mujoco.mjtObj.mjOBJ_JOINT, "njnt"),
    "site": (mujoco.mjtObj.mjOBJ_SITE, "nsite"),
    "geom": (mujoco.mjtObj.mjOBJ_GEOM, "ngeom"),
    "actuator": (mujoco.mjtObj.mjOBJ_ACTUATOR, "nactuator"),
    "sensor": (mujoco.mjtObj.mjOBJ_SENSOR, "nsensor"),
    "key": (mujoco.mjtObj.mjOBJ_KEY, "nkey"),
}
FIELDS = {
    "body": "pos quat gravcomp",
    "joint": "pos axis type stiffness limited range actfrclimited actfrcrange margin "
    "solref solimp actgravcomp",
    "dof": "armature damping frictionloss solref solimp",
    "geom": "type contype conaffinity condim priority friction margin gap solmix solref solimp",
    "actuator": "ctrllimited ctrlrange forcelimited forcerange gear gainprm biasprm dynprm "
    "gaintype biastype dyntype actlimited actrange delay",
    "sensor": "type dim noise cutoff",
    "key": "qpos qvel ctrl",
    "opt": "timestep integrator cone solver impratio gravity density "
    "viscosity disableflags enableflags o_solref o_solimp",
    "sizes": "nq nv nu na nbody njnt nsite ntendon neq nexclude npair nmocap nflex nskin",
}
"""What is compared besides what the two models do: the fields that lie under it."""


class Compiled:
    """A model, and where its things are by name."""

    def __init__(self, path: str) -> None:
        self.model = model = mujoco.MjModel.from_xml_path(path)
        # What is compared is the model, and not how far the solver went: from different roundings
        # it ends at different places within its tolerance.
        model.opt.tolerance = model.opt.noslip_tolerance = 1e-15
        model.opt.iterations = max(model.opt.iterations, 100)
        model.opt.ls_iterations, model.opt.ls_tolerance = 100, 1e-12
        self.data = mujoco.MjData(model)
        self.names: dict[str, list[str]] = {}
        for kind, (number, count) in KINDS.items():
            ids = range(getattr(model, count))
            self.names[kind] = [mujoco.mj_id2name(model, number, each) or "" for each in ids]

    def inertias(self) -> dict[str, Array]:
        """Return each body's mass, centre of mass, and inertia about that in the body's axes."""
        rows = []
        for body in range(self.model.nbody):
            row = np.zeros(9)
            mujoco.mju_quat2Mat(row, self.model.body_iquat[body])
            turn = row.reshape(3, 3)
            rows.append(turn @ np.diag(self.model.body_inertia[body]) @ turn.T)
        model = self.model
        return {
            "masses": model.body_mass,
            "centres of mass": model.body_ipos,
            "inertias": np.array(rows),
        }


def matching(first: Compiled, second: Compiled, kind: str) -> list[int | None]:
    """Return for each thing of a kind the one of the other model; None if there is none."""
    names, others = first.names[kind], second.names[kind]
    by_name = {name: index for index, name in enumerate(others) if name}
    found = [by_name.get(name) if name else None for name in names]
    taken = set(found)
    left = [index for index in range(len(others)) if index not in taken]
    if len(names) == len(others):  # those without a name have kept their places
        return [
            index if each is None and not names[index] and index not in taken else each
            for index, each in enumerate(found)
        ]
    nameless = [index for index, name in enumerate(names) if not name]
    found = list(found)
    for index, other in zip(nameless, left, strict=False):
        found[index] = other
    return found


class Comparison:
    """Two models, of which the second should do what the first does.

    Attributes:
        found: what differs, each with how far: a number as part of the greatest, or a text.
        fields: values that differ and can explain it, or matter only in other states.
    """

    def __init__(self, first: str, second: str, *, seed: int = 1, states: int = STATES) -> None:
        self.first, self.second = Compiled(first), Compiled(second)
        self.found: dict[str, str] = {}
        self.fields: dict[str, str] = {}
        self._random = np.random.default_rng(seed)
        self._roundings = np.random.default_rng(seed)
        self._maps = {kind: matching(self.first, self.second, kind) for kind in KINDS}
        one, two = self.first.model, self.second.model
        for size in ("nq", "nv", "nu"):
            if getattr(one, size) != getattr(two, size):
                self.found[size] = f"{getattr(one, size)} became {getattr(two, size)}"
        for kind in ("body", "joint", "site", "actuator", "sensor"):
            pairs = zip(self.first.names[kind], self._maps[kind], strict=True)
            missing = [name or f"#{i}" for i, (name, other) in enumerate(pairs) if other is None]
            if missing:
                self.found[f"{kind} missing"] = ", ".join(missing[:4]) + f" ({len(missing)})"
            places = [other for other in self._maps[kind] if other is not None]
            if places != sorted(places):
                self.found[f"order of {kind}s"] = "is another one"
        bodies, others = self.first.inertias(), self.second.inertias()
        for what in bodies:
            self._static(what, bodies[what], others[what], "body")
        self._compare_fields()
        if not {"nq", "nv"} & self.found.keys() and "joint missing" not in self.found:
            for _ in range(states):
                self._move()

    def _static(self, what: str, first: Array, second: Array, kind: str) -> None:
        for index, other in enumerate(self._maps[kind]):
            if other is not None:
                name = self.first.names[kind][index]
                least = 1e-3 if what == "centres of mass" else 1e-12
                self._note(what, first[index], second[other], name, usual=least)

    def _note(
        self, what: str, first: Array, second: Array, whose: str = "", *, usual: float = 1e-6
    ) -> None:
        first, second = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
        if first.shape != second.shape:
            self.found.setdefault(what, f"shapes {first.shape} and {second.shape} {whose}")
            return
        if not first.size:
            return
        off, size = _distance(first, second)
        part = off / max(size, usual)
        if not part <= TOLERANCE:
            known = self.found.get(what)
            if known is None or float(known.split()[0]) < part:
                self.found[what] = f"{part:.1e} {whose}".strip()

    # --- states ---

    def _spans(self) -> Iterator[tuple[int, slice, slice, slice, slice]]:
        one, two = self.first.model, self.second.model
        for index, other in enumerate(self._maps["joint"]):
            if other is None or one.jnt_type[index] != two.jnt_type[other]:
                continue
            width, depth = WIDTHS[int(one.jnt_type[index])]
            q, r = one.jnt_qposadr[index], two.jnt_qposadr[other]
            v, w = one.jnt_dofadr[index], two.jnt_dofadr[other]
            yield (
                index,
                slice(q, q + width),
                slice(r, r + width),
                slice(v, v + depth),
                slice(w, w + depth),
            )

    def _move(self) -> None:
        """Compare the two in a random state."""
        one, two = self.first, self.second
        random = self._random
        mujoco.mj_resetData(one.model, one.data)
        mujoco.mj_resetData(two.model, two.data)
        order: list[int] = [-1] * one.model.nv
        for index, q, r, v, w in self._spans():
            value = self._position(index)
            one.data.qpos[q] = two.data.qpos[r] = value
            speed = random.uniform(-1, 1, v.stop - v.start)
            one.data.qvel[v] = two.data.qvel[w] = speed
            order[v] = range(w.start, w.stop)
        if -1 in order:
            self.found.setdefault("joint types", "differ")
            return
        self._control(random)
        has_contacts = not one.model.opt.disableflags & NO_CONTACTS
        is_full = one.model.nv > CROWD
        try:
            for each in () if is_full else (one, two):
                mujoco.mj_forward(each.model, each.data)
            is_full |= bool(one.data.warning[FULL].number.any())
        except mujoco.FatalError:
            is_full = True
        if is_full or self._contacts_jump():
            for each in (one, two):
                each.model.opt.disableflags |= NO_CONTACTS
                try:
                    mujoco.mj_forward(each.model, each.data)
                except mujoco.FatalError:
                    if each is two:
                        raise
                    return  # MuJoCo has no memory for this state of the model itself
        full, other = (np.zeros((each.model.nv, each.model.nv)) for each in (one, two))
        mujoco.mj_fullM(one.model, one.data, full)
        mujoco.mj_fullM(two.model, two.data, other)
        self._note("mass matrix", full, other[np.ix_(order, order)])
        usual = 1e-4 * np.abs(full).max(initial=0.0)  # of forces: less is rounding
        for name in ("qfrc_bias", "qfrc_passive", "qfrc_actuator"):
            forces = getattr(one.data, name), getattr(two.data, name)[order]
            self._note(name, *forces, usual=usual)
        self._compare_actuators()
        noise = self._noise()
        for index, twin in enumerate(self._maps["site"]):
            if twin is not None:
                label = one.names["site"][index]
                size = 1 + np.abs(one.data.site_xpos).max()
                shift = (one.data.site_xpos[index] - two.data.site_xpos[twin]) / size
                self._note("site poses", shift + 1, np.ones(3), label)
                turns = one.data.site_xmat[index], two.data.site_xmat[twin]
                self._note("site poses", *turns, label)
        self._compare_sensors(noise)
        if has_contacts:
            for each in (one, two):
                each.model.opt.disableflags &= ~NO_CONTACTS

    def _contacts_jump(self) -> bool:
        """Return whether contacts differ by more than roundings of the same shapes could.

        The direction of a contact of two convex shapes can jump.
        """
        one, two = self.first.data, self.second.data
        places = self._maps["geom"]
        if not one.ncon or None in places:
            return False
        for name in ("xpos", "xmat"):
            first, second = (getattr(each, f"geom_{name}") for each in (one, two))
            if not np.abs(first - second[places]).max(initial=0.0) <= SAME_PLACE:
                return False
        sizes = self.first.model.geom_size, self.second.model.geom_size[places]
        if not np.allclose(*sizes, rtol=SAME_PLACE, atol=0):
            return False
        if one.ncon != two.ncon:
            return True
        return bool(np.abs(one.contact.frame - two.contact.frame).max(initial=0.0) > SAME_PLACE)

    def _noise(self) -> Array:
        """Return how much a rounding of positions changes what each sensor measures.

        Contacts of surfaces that are nearly parallel can multiply a rounding, as can a solver that
        begins elsewhere; what falls freely has no acceleration but that of roundings.
        """
        one = self.first
        if not one.model.nsensor:
            return np.zeros_like(one.data.sensordata)
        before = one.data.sensordata.copy()
        rows = [one.data.qpos, *(getattr(one.model, name) for name in ROUNDED)]
        kept = [row.copy() for row in rows]
        found = np.zeros_like(before)
        for _ in range(5):
            for row, own in zip(rows, kept, strict=True):
                row[:] = own * (1 + ROUNDING * self._roundings.uniform(-1, 1, own.shape))
            one.data.qacc_warmstart[:] = self._roundings.uniform(-1, 1, one.model.nv)
            mujoco.mj_forward(one.model, one.data)
            found = np.maximum(found, np.abs(one.data.sensordata - before))
        for row, own in zip(rows, kept, strict=True):
            row[:] = own
        mujoco.mj_forward(one.model, one.data)
        return found

    def _position(self, index: int) -> Array:
        model, random = self.first.model, self._random
        kind = model.jnt_type[index]
        if kind >= 2:
            low, high = model.jnt_range[index] if model.jnt_limited[index] else (-1, 1)
            return random.uniform(low, high, 1)
        turn = random.normal(size=4)
        turn /= np.linalg.norm(turn)
        return turn if kind == 1 else np.concatenate([random.uniform(-1, 1, 3), turn])

    def _control(self, random: np.random.Generator) -> None:
        one, two = self.first, self.second
        for index, other in enumerate(self._maps["actuator"]):
            count = int(one.model.actuator_ctrlnum[index])
            first = int(one.model.actuator_ctrladr[index])
            for part in range(count):
                ends = one.model.actuator_ctrlrange[first + part]
                limited = one.model.actuator_ctrllimited[first + part]
                value = random.uniform(*(ends if limited else (-1, 1)))
                one.data.ctrl[first + part] = value
                if other is not None and part < two.model.actuator_ctrlnum[other]:
                    two.data.ctrl[int(two.model.actuator_ctrladr[other]) + part] = value
            number = int(one.model.actuator_actnum[index])
            if number > 0 and other is not None and two.model.actuator_actnum[other] == number:
                value = random.uniform(0, 1, number)
                at, to = one.model.actuator_actadr[index], two.model.actuator_actadr[other]
                one.data.act[at : at + number] = value
                two.data.act[to : to + number] = value

    def _compare_actuators(self) -> None:
        one, two = self.first, self.second
        size = np.abs(one.data.actuator_force).max(initial=0.0) or 1.0
        for index, other in enumerate(self._maps["actuator"]):
            if other is None:
                continue
            at, to = (
                int(m.actuator_outadr[i]) for m, i in ((one.model, index), (two.model, other))
            )
            shift = (one.data.actuator_force[at] - two.data.actuator_force[to]) / size
            name = one.names["actuator"][index]
            self._note("actuator forces", shift + 1, np.ones(1)[0], name)

    def _compare_sensors(self, noise: Array) -> None:
        one, two = self.first, self.second
        for index, other in enumerate(self._maps["sensor"]):
            if other is None:
                continue
            rows: list[Array] = []
            for each, number in ((one, index), (two, other)):
                start = each.model.sensor_adr[number]
                rows.append(each.data.sensordata[start : start + each.model.sensor_dim[number]])
            kind = mujoco.mjtSensor(int(one.model.sensor_type[index])).name.removeprefix("mjSENS_")
            start, size = one.model.sensor_adr[index], one.model.sensor_dim[index]
            usual = max(1e-6, NOISE / TOLERANCE * noise[start : start + size].max(initial=0.0))
            name = f"{kind} {one.names['sensor'][index]}"
            self._note("sensors", rows[0], rows[1], name, usual=usual)

    # --- fields ---

    def _compare_fields(self) -> None:
        """Compare what the models have by numbers."""
        one, two = self.first.model, self.second.model
        for kind, names in FIELDS.items():
            for name in names.split():
                if kind in ("opt", "sizes"):
                    holders = (one.opt, two.opt) if kind == "opt" else (one, two)
                    first, second = (np.asarray(getattr(each, name)) for each in holders)
                    if _differ(first, second):
                        self.fields[f"{kind} {name}"] = f"{first} became {second}"
                    continue
                prefix = {"joint": "jnt"}.get(kind, kind)
                first, second = (getattr(each, f"{prefix}_{name}") for each in (one, two))
                pairs: list[tuple[int, int, str]]
                if kind == "dof":
                    if one.nv != two.nv:
                        continue
                    pairs = [
                        (v.start, w.start, self.first.names["joint"][index])
                        for index, _, _, v, w in self._spans()
                    ]
                elif kind == "actuator" and name in ("ctrllimited", "ctrlrange"):
                    if one.nu != two.nu:
                        continue
                    pairs = [(index, index, f"#{index}") for index in range(one.nu)]
                else:
                    pairs = [
                        (index, other, self.first.names[kind][index])
                        for index, other in enumerate(self._maps[kind])
                        if other is not None
                    ]
                off = [who for a, b, who in pairs if _differ(first[a], second[b])]
                if off:
                    a, b, who = next(
                        pair for pair in pairs if _differ(first[pair[0]], second[pair[1]])
                    )
                    self.fields[f"{kind} {name}"] = (
                        f"{first[a]} became {second[b]} of {who!r}, {len(off)} of {len(pairs)}"
                    )


def _differ(first: Array, second: Array) -> bool:
    first, second = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    if first.shape != second.shape:
        return True
    off, size = _distance(first, second)
    return not off <= TOLERANCE * max(size, 1.0)


def _distance(first: Array, second: Array) -> tuple[float, float]:
    """Return the greatest difference of two arrays, and their greatest value; NaN is NaN."""
    if not first.size:
        return 0.0, 0.0
    both = np.isnan(first) & np.isnan(second)
    off = np.where(both, 0.0, np.abs(first - second))
    size = np.nanmax(np.abs(first), initial=0.0)
    return float(off.max()), float(size)
