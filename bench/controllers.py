"""Checks files of controllers against the parameters that ros2_controllers declares.

    python bench/controllers.py CHECKOUT [FILE…] [--names]

CHECKOUT is a folder with ros2_controllers and perhaps ros2_control, of any version. Each FILE is
one that `yamaro --to controllers` has written: each of its parameters has to be declared, by
generate_parameter_library, for the plugin that the controller manager is to load, with that type,
and has to pass the validators that need nothing but the value. What is declared without a default
has to be there. `--names` compares the names that Yamaro knows with those that are declared.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

sys.path.insert(0, str(Path(__file__).parents[1] / "src"))

Json = dict[str, Any]
TYPES: dict[str, tuple[type, ...]] = {
    "bool": (bool,),
    "int": (int,),
    "double": (float,),
    "string": (str,),
}
NODE = {"use_sim_time", "update_rate", "is_async"}
"""Parameters of every controller, which are declared elsewhere."""


def schemas(checkout: Path) -> Iterator[tuple[Path, str, Json]]:
    """Yield each declaration: its file, the name in it, and the parameters."""
    for folder in ("src", "config"):
        for path in sorted(checkout.glob(f"**/{folder}/*.yaml")):
            try:
                data = yaml.safe_load(path.read_text(encoding="utf-8"))
            except (yaml.YAMLError, UnicodeDecodeError):
                continue
            for name, body in data.items() if isinstance(data, dict) else ():
                if isinstance(body, dict) and any(map(is_declared, leaves(body))):
                    yield path, name, body


def is_declared(entry: object) -> bool:
    """Return whether an entry is the declaration of a parameter."""
    return isinstance(entry, dict) and isinstance(entry.get("type"), str)


def leaves(body: Json) -> Iterator[object]:
    """Yield what is at the ends of a tree of parameters."""
    for entry in body.values():
        if is_declared(entry) or not isinstance(entry, dict):
            yield entry
        else:
            yield from leaves(entry)


def declared(checkout: Path) -> dict[str, Json]:
    """Return the parameters of each plugin by its class, those of its base class among them."""
    found: dict[str, Json] = {}
    known = list(schemas(checkout))
    base = next((body for _, name, body in known if name == "steering_controllers_library"), {})
    for plugins in checkout.glob("**/*.xml"):
        if plugins.name == "package.xml" or "/test/" in plugins.as_posix():
            continue
        text = plugins.read_text(encoding="utf-8", errors="replace")
        for name in re.findall(r'class name="([^"]+/[^"]+)"', text):
            own = [(n, b) for path, n, b in known if plugins.parent in path.parents]
            word = re.sub(r"(?<!^)(?=[A-Z][a-z])", "_", name.partition("/")[2]).lower()
            if len(own) > 1:
                own = [(n, b) for n, b in own if n == word] or own[:1]
            if own:
                found[name] = {**(base if "steering" in own[0][0] else {}), **own[0][1]}
    for effort in ("position", "effort"):
        grippers = [b for _, n, b in known if n == "gripper_action_controller"]
        if grippers:
            found[f"{effort}_controllers/GripperActionController"] = grippers[0]
    return found


def faults(file: Path, plugins: dict[str, Json], manager: Json | None) -> Iterator[str]:
    """Yield what ROS would not take of a file, or would ignore."""
    data = yaml.safe_load(file.read_text(encoding="utf-8"))
    own = data["controller_manager"]["ros__parameters"]
    types = {n: v["type"] for n, v in own.items() if isinstance(v, dict) and "type" in v}
    rest = {name: value for name, value in own.items() if name not in types}
    if manager is not None:
        yield from unfit("controller_manager", rest, manager, {})
    for name, plugin in types.items():
        given = data.get(name, {}).get("ros__parameters", {})
        if plugin not in plugins:
            yield f"{name}: nothing declares the parameters of {plugin}"
            continue
        yield from unfit(name, given, plugins[plugin], given)
    yield from (f"{n}: is no controller" for n in data if n not in (*types, "controller_manager"))


def unfit(where: str, given: Json, body: Json, root: Json) -> Iterator[str]:
    """Yield what is wrong with parameters below a name."""
    given = nested(given)
    for name, value in given.items():
        entry = body.get(name)
        if entry is None:  # the name of a joint, of which another parameter has the list
            maps = {key.removeprefix("__map_"): body[key] for key in body if key[:6] == "__map_"}
            entry = next((own for key, own in maps.items() if name in root.get(key, [])), None)
        if entry is None and name in NODE:
            continue
        if entry is None:
            yield f"{where}.{name}: is not declared"
        elif not is_declared(entry):
            if isinstance(value, dict):
                yield from unfit(f"{where}.{name}", value, entry, root)
            else:
                yield f"{where}.{name}: is a group of parameters"
        else:
            yield from wrong(f"{where}.{name}", value, entry)
    for name, entry in body.items():
        if is_declared(entry) and name not in given and not name.startswith("__map_"):
            if "default_value" not in entry and entry["type"] != "none":
                yield f"{where}.{name}: has no default"
            elif entry.get("default_value") in ("", [], 0.0):
                problems = list(wrong(f"{where}.{name}", entry["default_value"], entry))
                yield from (f"{each}, as by default" for each in problems)


def nested(given: Json) -> Json:
    """Return parameters in which names with dots are nested."""
    found: Json = {}
    for name, value in given.items():
        *above, last = str(name).split(".")
        into = found
        for part in above:
            into = into.setdefault(part, {})
        if isinstance(value, dict) and isinstance(into.get(last), dict):
            into[last] |= value
        else:
            into[last] = value
    return found


def wrong(where: str, value: object, entry: Json) -> Iterator[str]:
    """Yield what is wrong with a value: its type, or what a validator says."""
    kind = entry["type"]
    if kind == "none":
        return
    items = value if isinstance(value, list) else [value]
    if ("_array" in kind) != isinstance(value, list):
        yield f"{where}: {value!r} is not a {kind}"
    single = kind.partition("_array")[0]
    if not all(type(each) in TYPES[single] for each in items):
        yield f"{where}: {value!r} is not a {kind}"
        return
    for rule, limit in (entry.get("validation") or {}).items():
        limits = limit if isinstance(limit, list) else [limit]
        if not holds(rule.removesuffix("<>"), value, items, limits):
            yield f"{where}: {value!r} fails {rule} {limits}"


def holds(rule: str, value: Any, items: list[Any], limits: list[Any]) -> bool:
    """Return whether a validator accepts a value; those that need more are taken to."""
    match rule:
        case "not_empty":
            return bool(value)
        case "unique":
            return len(set(items)) == len(items)
        case "gt":
            return all(each > limits[0] for each in items)
        case "gt_eq":
            return all(each >= limits[0] for each in items)
        case "size_gt":
            return len(items) > limits[0]
        case "size_lt":
            return len(items) < limits[0]
        case "fixed_size":
            return len(items) == limits[0]
        case "one_of":
            return value in (limits[0] if isinstance(limits[0], list) else limits)
        case "subset_of":
            return set(items) <= set(limits[0])
        case "control_filters::gt_eq_or_nan":
            return all(each >= limits[0] or each != each for each in items)
        case "control_filters::lt_eq_or_nan":
            return all(each <= limits[0] or each != each for each in items)
        case "joint_trajectory_controller::command_interface_type_combinations":
            return items in (
                *(["position"], ["velocity"], ["effort"], ["position", "velocity"]),
                *(["position", "effort"], ["position", "velocity", "acceleration"]),
            )
    return True


def unknown_names(plugins: dict[str, Json]) -> Iterator[str]:
    """Yield the names in which Yamaro's table and a checkout differ."""
    from yamaro.model.controllers import TYPES as KNOWN

    for known in KNOWN.values():
        for plugin in filter(None, (known.plugin, known.older)):
            if plugin in plugins:
                missing = {name.split(".")[0] for name in plugins[plugin]} - {*known.parameters}
                missing = {name for name in missing if not name.startswith("__map_")}
                yield from (f"{known.word}: {name} is not in the table" for name in sorted(missing))


def main(arguments: list[str]) -> int:
    """Check files; return 1 if one has a fault."""
    checkout, *files = [Path(each) for each in arguments if not each.startswith("-")]
    plugins = declared(checkout)
    manager = next((b for _, name, b in schemas(checkout) if name == "controller_manager"), None)
    found = [f"{file}: {each}" for file in files for each in faults(file, plugins, manager)]
    if "--names" in arguments:
        found += unknown_names(plugins)
    print(*found, f"{len(files)} files, {len(plugins)} plugins, {len(found)} faults", sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    if not sys.argv[1:]:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
