"""The interpreter and a small model of the rules of scopes agree on random programs.

The model below is written from the language's rules alone and shares nothing with the interpreter:
contexts are plain records, every lookup walks them anew, and programs are lists of tuples.
"""

from __future__ import annotations

import copy
import json
import os
import random
from typing import Any

from tests.effort import examples
from yamaro.api import build
from yamaro.diagnostics import YamaroError
from yamaro.files.loader import MemoryLoader

COUNT = int(os.environ.get("YAMARO_SCOPE_EXAMPLES", examples(1000)))
SEED = int(os.environ.get("YAMARO_FUZZ_SEED", "0"))
MAX_STEPS, MAX_DEPTH = 600, 60

NAMES = ("x", "y", "z")
SCOPES = ("local", "global", "parent", "child", "bridge")
FILES = ("main", "a", "b", "c")
FUNCTIONS = ("F0", "F1", "F2", "F3", "F4")
# Code may call and include only what stands to its right, so that nearly every program ends.
RANKS = ("main", "a", "F0", "F1", "b", "F2", "F3", "c", "F4")

Statement = tuple[Any, ...]
Body = list[Statement]


# --- the model --------------------------------------------------------------------------------


class Context:
    """One run of a file or one call; `own` maps names to [scope, value]."""

    def __init__(self, closure: Env | None, caller: Context | None) -> None:
        self.own: dict[str, list[Any]] = {}
        self.closure = closure
        self.caller = caller
        self.passed: set[str] = set()


class RunningBlock:
    """A block that runs in a call and was written elsewhere.

    Functions that come back to it are its own: nobody else could name them.
    """

    def __init__(self, insertion: Env, written: Env) -> None:
        self.insertion = insertion  # what is around the place that inserts it
        self.written = written
        self.received: dict[str, Any] = {}


Env = Context | RunningBlock


class Stop(Exception):
    """The program ends with an error of this code, in this statement."""

    def __init__(self, code: str) -> None:
        super().__init__(code)
        self.code = code
        self.statement: Statement | None = None


class TooLong(Exception):
    """The program takes more steps than a test should."""


UNDEFINED = object()


def is_function(name: str) -> bool:
    return name[0].isupper()


class Model:
    def __init__(self, program: dict[str, Any]) -> None:
        self.files = program["files"]
        self.functions = program["functions"]
        self.globals: dict[str, Any] = {}
        self.bridges: dict[str, Any] = {}
        self.shared_now: list[set[str]] = []  # global and bridge names declared in each include
        self.printed: list[str] = []
        self.steps = self.depth = 0

    # Where names are.

    def around(self, env: Env) -> list[Context]:
        """The contexts whose own names are seen by the place something is written at."""
        if isinstance(env, RunningBlock):
            return [*self.calls_seen(env.insertion), *self.around(env.written)]
        return [env, *(self.around(env.closure) if env.closure is not None else [])]

    def calls_seen(self, env: Env) -> list[Context]:
        """The contexts that a place sees because it runs in them, and not by closure."""
        if isinstance(env, RunningBlock):
            return [*self.calls_seen(env.insertion), *self.calls_seen(env.written)]
        return [env]

    def context(self, env: Env) -> Context:
        return self.context(env.insertion) if isinstance(env, RunningBlock) else env

    def callers(self, env: Env) -> list[Context]:
        found = []
        caller = self.context(env).caller
        while caller is not None:
            found.append(caller)
            caller = caller.caller
        return found

    def callers_child(self, name: str, env: Env) -> Any:
        for caller in self.callers(env):
            if name in caller.own and caller.own[name][0] == "child":
                return caller.own[name][1]
        return UNDEFINED

    def find(self, name: str, env: Env) -> Any:
        if is_function(name) and isinstance(env, RunningBlock):
            return env.received[name] if name in env.received else self.find(name, env.written)
        for context in self.around(env):
            if name in context.own:
                scope, value = context.own[name]
                return self.bridges[name] if scope == "bridge" else value
        value = self.callers_child(name, env)
        if value is not UNDEFINED:
            return value
        return self.bridges.get(name, self.globals.get(name, UNDEFINED))

    # Changing them.

    def declare(self, name: str, value: Any, scope: str, env: Env) -> None:
        context = self.context(env)
        if scope in ("global", "bridge"):
            for names in self.shared_now:
                names.add(name)
        if scope == "global":
            context.own.pop(name, None)
            self.globals[name] = value
        elif scope == "bridge":
            self.bridges[name] = value
            for each in (context, *self.callers(context)):
                each.own[name] = ["bridge", None]
        else:
            context.own[name] = [scope, value]

    def assign(self, name: str, value: Any, env: Env) -> None:
        for context in self.around(env):
            if name in context.own:
                if context.own[name][0] == "bridge":
                    self.bridges[name] = value
                else:
                    context.own[name][1] = value
                return
        if self.callers_child(name, env) is not UNDEFINED:
            self.declare(name, value, "local", env)
        elif name in self.bridges:
            self.bridges[name] = value
        elif name in self.globals:
            self.globals[name] = value
        else:
            self.declare(name, value, "local", env)

    # Running.

    def run_program(self, passed: dict[str, int]) -> Stop | None:
        """Run the main file; return the error it ends with, if any."""
        try:
            self.run_file("main", Context(None, None), passed)
        except Stop as stop:
            return stop
        return None

    def run_file(self, name: str, context: Context, passed: dict[str, Any]) -> None:
        for key, value in passed.items():
            context.own[key] = ["local", value]
        context.passed = set(passed)
        for statement in self.files[name]["sections"]:
            if statement[0] == "declare":
                for key, scope, value in statement[1]:
                    self.declare_at_root(key, scope, value, context)
            else:
                self.run(statement, context)
        self.run_body(self.files[name]["model"], context)

    def declare_at_root(self, name: str, scope: str, value: Any, context: Context) -> None:
        bridge_arrives = name in self.bridges and context.own.get(name, [""])[0] != "bridge"
        child_arrives = self.callers_child(name, context) is not UNDEFINED
        if name in context.passed or child_arrives or bridge_arrives:
            if scope == "local" and name in self.bridges:
                return  # it stays the bridge it is
            value = self.find(name, context)
        self.declare(name, value, scope, context)

    def run_body(self, body: Body, env: Env) -> None:
        for statement in body:
            self.run(statement, env)

    def run(self, statement: Statement, env: Env) -> None:
        self.steps += 1
        if self.steps > MAX_STEPS or self.depth > MAX_DEPTH:
            raise TooLong
        kind, *rest = statement
        self.depth += 1
        try:
            getattr(self, f"run_{kind}")(env, *rest)
        except Stop as stop:
            stop.statement = stop.statement or statement
            raise
        self.depth -= 1

    def run_declare(self, env: Env, entries: list[tuple[str, str, Any]]) -> None:
        for name, scope, value in entries:
            self.declare(name, value, scope, env)

    def run_assign(self, env: Env, name: str, value: int) -> None:
        self.assign(name, value, env)

    def run_read(self, env: Env, name: str) -> None:
        value = self.find(name, env)
        self.printed.append(f"{name} {'?' if value is UNDEFINED else value}")

    def run_read_in_namespace(self, env: Env, name: str) -> None:
        space = self.find("ns", env)
        value = UNDEFINED if space is UNDEFINED else self.in_namespace(space, name)
        self.printed.append(f"ns.{name} {'?' if value is UNDEFINED else value}")

    def in_namespace(self, space: dict[str, Any], name: str) -> Any:
        if name in space and space[name] is UNDEFINED:
            return self.bridges.get(name, self.globals.get(name, UNDEFINED))
        return space.get(name, UNDEFINED)

    def run_need(self, env: Env, name: str) -> None:
        value = self.find(name, env)
        if value is UNDEFINED:
            raise Stop("undefined-name")
        self.printed.append(str(value))

    def run_branch(self, env: Env, body: Body) -> None:
        self.run_body(body, env)

    def run_loop(self, env: Env, name: str, items: list[int], body: Body) -> None:
        for item in items:
            self.declare(name, item, "local", env)
            self.run_body(body, env)

    def run_define(self, env: Env, name: str, scope: str) -> None:
        self.declare(name, (self.functions[name], env), scope, env)

    def run_insert(self, env: Env, default: Body | None) -> None:
        block = self.find("Block", env)
        if block is not None and block is not UNDEFINED:
            body, written = block
            self.run_body(body, RunningBlock(env, written))
        elif default is not None:
            self.run_body(default, env)

    def run_call(
        self, env: Env, name: str, via: str, given: dict[str, Any], block: Body | None
    ) -> None:
        if via == "namespace":
            space = self.namespace_of_functions(env)
            found = UNDEFINED if space is UNDEFINED else self.in_namespace(space, name)
        else:
            found = self.find(name, env)
        if found is UNDEFINED:
            raise Stop("undefined-function")
        function, closure = found
        values = {
            parameter: self.value(given[parameter], env)
            for parameter, _ in function["parameters"]
            if parameter in given
        }
        callee = Context(closure, self.context(env))
        for parameter, default in function["parameters"]:
            if parameter not in values:
                values[parameter] = self.value(default, callee)
            callee.own[parameter] = ["local", values[parameter]]
        if function["has_block"]:
            callee.own["Block"] = ["local", None if block is None else (block, env)]
        self.run_body(function["body"], callee)
        self.receive(self.exports(callee), env)

    def namespace_of_functions(self, env: Env) -> Any:
        if isinstance(env, RunningBlock) and "ns" not in env.received:
            return self.namespace_of_functions(env.written)
        return env.received["ns"] if isinstance(env, RunningBlock) else self.find("ns", env)

    def value(self, expression: tuple[str, Any], env: Env) -> Any:
        kind, content = expression
        if kind == "constant":
            return content
        value = self.find(content, env)
        if value is UNDEFINED:
            raise Stop("undefined-name")
        return value

    def run_include(self, env: Env, file: str, given: dict[str, Any], has_namespace: bool) -> None:
        passed = {name: self.value(value, env) for name, value in given.items()}
        context = Context(None, self.context(env))
        self.shared_now.append(set())
        self.run_file(file, context, passed)
        shared = self.shared_now.pop()
        if not has_namespace:
            self.receive(self.exports(context), env)
            return
        _, space = self.context(env).own.get("ns", ["local", {}])
        self.declare("ns", space, "local", env)
        if isinstance(env, RunningBlock):
            env.received["ns"] = space
        space.update(self.exports(context))
        space.update(dict.fromkeys(shared, UNDEFINED))  # looked up when it is read

    def receive(self, names: list[tuple[str, Any]], env: Env) -> None:
        for name, value in names:
            if is_function(name) and isinstance(env, RunningBlock):
                env.received[name] = value
            else:
                self.declare(name, value, "local", env)

    def exports(self, context: Context) -> list[tuple[str, Any]]:
        return [(key, value) for key, (scope, value) in context.own.items() if scope == "parent"]


# --- random programs --------------------------------------------------------------------------


class Writer:
    """Draws the code of one program."""

    def __init__(self, rng: random.Random) -> None:
        self.rng = rng
        self.number = 0
        self.homes = {
            name: self.pick(*FILES, *FUNCTIONS[:index]) for index, name in enumerate(FUNCTIONS)
        }
        self.signatures = {name: self.signature() for name in FUNCTIONS}

    def pick(self, *choices: Any) -> Any:
        return self.rng.choice(choices)

    def chance(self) -> bool:
        return self.rng.random() < 0.5

    def names(self, most: int) -> list[str]:
        return self.rng.sample(NAMES, self.rng.randint(0, most))

    def fresh(self) -> int:
        self.number += 1
        return self.number

    def expression(self) -> tuple[str, Any]:
        name = ("name", self.pick(*NAMES))
        return self.pick(("constant", self.fresh()), ("constant", self.fresh()), name)

    def signature(self) -> dict[str, Any]:
        parameters = [(name, self.expression()) for name in self.names(2)]
        return {"parameters": parameters, "has_block": self.chance()}

    def has_block(self, unit: str) -> bool:
        """Whether `Block:` means a block in the body of a function: its own, or one around it."""
        if unit in FILES:
            return False
        return self.signatures[unit]["has_block"] or self.has_block(self.homes[unit])

    def program(self) -> dict[str, Any]:
        files = {name: self.file(name) for name in FILES}
        functions = {
            name: {**self.signatures[name], "body": self.body(name, 0)} for name in FUNCTIONS
        }
        for name, home in self.homes.items():
            define = ("define", name, self.pick(*SCOPES))
            if home in FILES:
                part = files[home][self.pick("sections", "sections", "model")]
            else:
                part = functions[home]["body"]
            part.insert(self.rng.randint(0, len(part)), define)
        passed = {name: self.fresh() for name in self.names(1)}
        return {"files": files, "functions": functions, "passed": passed}

    def file(self, name: str) -> dict[str, Body]:
        sections = []
        for _ in range(self.pick(0, 1, 2)):
            assign = ("assign", self.pick(*NAMES), self.fresh())
            sections.append(self.pick(self.declaration(), self.declaration(), assign))
        return {"sections": sections, "model": self.body(name, 0)}

    def declaration(self) -> Statement:
        names = self.names(2) or [self.pick(*NAMES)]
        return ("declare", [(name, self.pick(*SCOPES), self.fresh()) for name in names])

    def body(self, unit: str, depth: int) -> Body:
        size = self.rng.randint(3, 8) if depth == 0 else self.rng.randint(1, 3)
        return [self.statement(unit, depth) for _ in range(size)]

    def statement(self, unit: str, depth: int) -> Statement:
        later = RANKS[RANKS.index(unit) + 1 :]
        kinds = ["declare", "declare", "assign", *["read"] * 5, "read_in_namespace"]
        if depth < 2:
            kinds += ["branch", "loop", "need"]
            kinds += ["start"] * 6 if later else []
            kinds += ["insert"] * 3 if self.has_block(unit) else []
        kind = self.pick(*kinds)
        if kind == "start":
            started = self.pick(*later)
            return self.include(started) if started in FILES else self.call(started, unit, depth)
        if kind == "declare":
            return self.declaration()
        if kind == "assign":
            return (kind, self.pick(*NAMES), self.fresh())
        if kind == "branch":
            return (kind, self.body(unit, depth + 1))
        if kind == "loop":
            items = [self.fresh() for _ in range(self.pick(1, 2))]
            return (kind, self.pick(*NAMES), items, self.body(unit, depth + 1))
        if kind == "insert":
            return (kind, self.body(unit, depth + 1) if self.chance() else None)
        return (kind, self.pick(*NAMES))

    def include(self, file: str) -> Statement:
        given = {name: self.expression() for name in self.names(2)}
        return ("include", file, given, self.pick(False, False, True))

    def call(self, name: str, unit: str, depth: int) -> Statement:
        signature = self.signatures[name]
        given = {key: self.expression() for key, _ in signature["parameters"] if self.chance()}
        block = None
        if signature["has_block"] and self.chance():
            block = self.body(unit, depth + 1)
        return ("call", name, self.pick("name", "name", "name", "namespace"), given, block)


class ChainWriter(Writer):
    """Draws programs whose functions call the next one with a block that inserts their own."""

    def __init__(self, rng: random.Random) -> None:
        super().__init__(rng)
        self.homes = dict.fromkeys(FUNCTIONS, "main")
        self.signatures = {name: {**self.signature(), "has_block": True} for name in FUNCTIONS}

    def program(self) -> dict[str, Any]:
        program = super().program()
        model = program["files"]["main"]["model"]
        given: dict[str, Any] = {}
        model.append(("call", FUNCTIONS[0], "name", given, [("read", name) for name in NAMES]))
        return program

    def body(self, unit: str, depth: int) -> Body:
        if depth > 0 or unit not in FUNCTIONS:
            return super().body(unit, depth)
        later = FUNCTIONS[FUNCTIONS.index(unit) + 1 :]
        insertion = ("insert", [("read", self.pick(*NAMES))])
        if not later:
            return [self.declaration(), insertion]
        given = {key: self.expression() for key, _ in self.signatures[later[0]]["parameters"]}
        block = [self.pick(self.declaration(), ("read", "x")), insertion, ("read", "y")]
        return [
            self.pick(self.declaration(), insertion),
            ("call", later[0], "name", given, block),
        ]


def make_program(number: int) -> dict[str, Any]:
    """Return a random program; most are without the statements that would end them early."""
    rng = random.Random(number)
    program = (ChainWriter if number % 8 == 7 else Writer)(rng).program()
    if rng.random() < 0.8:
        for _ in range(40):
            stop = outcome_by_the_rules(program)[2]
            if stop is None:
                break
            strike_out(stop.statement, program)
    return program


def bodies_of(program: dict[str, Any]) -> list[Body]:
    """Return the outermost bodies of a program."""
    files = [body for file in program["files"].values() for body in file.values()]
    return files + [function["body"] for function in program["functions"].values()]


def all_statements(code: Any) -> list[Statement]:
    """Return the statements in some bodies, inner ones first."""
    found = []
    if isinstance(code, (list, tuple)):
        for each in code:
            found += all_statements(each)
            if isinstance(code, list) and isinstance(each, tuple) and isinstance(each[0], str):
                found.append(each)
    return found


def strike_out(statement: Statement | None, program: dict[str, Any]) -> None:
    """Remove a statement from everywhere in a program."""

    def strike(code: Any) -> None:
        if isinstance(code, list):
            code[:] = [each for each in code if each is not statement]
        if isinstance(code, (list, tuple)):
            for each in code:
                strike(each)

    strike(bodies_of(program))


def outcome_by_the_rules(program: dict[str, Any]) -> tuple[list[str], str | None, Stop | None]:
    """Return what a program prints, the code of the error it ends with, and that error."""
    model = Model(program)
    try:
        stop = model.run_program(program["passed"])
    except TooLong:
        return [], "too long", None
    return model.printed, stop.code if stop else None, stop


# --- the same program in YAML (of which JSON is a part) ---------------------------------------


def spell_value(value: tuple[str, Any]) -> object:
    return value[1] if value[0] == "constant" else f"$({value[1]})"


def spell_body(body: Body, program: dict[str, Any]) -> list[dict[str, Any]]:
    return [spell(statement, program) for statement in body]


def spell_declaration(entries: list[tuple[str, str, int]]) -> dict[str, int]:
    return {f"{name}/{scope}": value for name, scope, value in entries}


def spell_read(name: str) -> str:
    faults = "(NameError, AttributeError)" if "." in name else "NameError"
    return f"try:\n  print('{name}', {name})\nexcept {faults}:\n  print('{name}', '?')\n"


def spell(statement: Statement, program: dict[str, Any]) -> dict[str, Any]:
    match statement:
        case ("declare", entries):
            return {"variables": spell_declaration(entries)}
        case ("assign", name, value):
            return {"process": f"{name} = {value}"}
        case ("read", name):
            return {"process": spell_read(name)}
        case ("read_in_namespace", name):
            return {"process": spell_read(f"ns.{name}")}
        case ("need", name):
            return {"print": f"$({name})"}
        case ("branch", body):
            return {"if": {"condition": True, "body": spell_body(body, program)}}
        case ("loop", name, items, body):
            inner = spell_body(body, program)
            return {"for": {"iterator": name, "in": items, "body": inner}}
        case ("define", name, scope):
            return {"functions": {f"{name}/{scope}": spell_function(name, program)}}
        case ("insert", default):
            return {"Block": None if default is None else spell_body(default, program)}
        case ("call", name, via, given, block):
            arguments = {key: spell_value(value) for key, value in given.items()}
            if block is not None:
                arguments["Block"] = spell_body(block, program)
            return {f"ns.{name}" if via == "namespace" else name: arguments or None}
        case ("include", file, given, has_namespace):
            namespace = {"namespace": "ns"} if has_namespace else {}
            passed = {key: spell_value(value) for key, value in given.items()}
            return {"include": {"path": f"{file}.yaml", **namespace, **passed}}
    raise AssertionError(statement)


def spell_function(name: str, program: dict[str, Any]) -> dict[str, Any]:
    function = program["functions"][name]
    parameters = [f"{key}={spell_value(value)}" for key, value in function["parameters"]]
    if function["has_block"]:
        parameters.append("**Block")
    return {"input": parameters, "body": spell_body(function["body"], program)}


def spell_file(name: str, program: dict[str, Any]) -> str:
    file = program["files"][name]
    sections = spell_body(file["sections"], program)
    return json.dumps([*sections, {"model": spell_body(file["model"], program)}], indent=1)


def run_interpreter(program: dict[str, Any]) -> tuple[list[str], str | None]:
    files = {f"/{name}.yaml": spell_file(name, program) for name in FILES}
    printed: list[str] = []
    try:
        build(
            "/main.yaml",
            loader=MemoryLoader(files),
            variables=program["passed"],
            on_message=printed.append,
            allow=["no-link"],  # which is no matter of scopes
        )
    except YamaroError as error:
        return printed, error.diagnostics[-1].code
    return printed, None


def spell_program(program: dict[str, Any]) -> str:
    return "\n".join(f"--- {name}.yaml\n{spell_file(name, program)}" for name in FILES)


def disagree(program: dict[str, Any]) -> bool:
    printed, code, _ = outcome_by_the_rules(program)
    return code != "too long" and run_interpreter(program) != (printed, code)


def shrink(program: dict[str, Any]) -> dict[str, Any]:
    """Return a small program on which the interpreter and the rules still disagree."""
    while True:
        for statement in reversed(all_statements(bodies_of(program))):
            smaller = copy.deepcopy(program, {id(statement): statement})
            strike_out(statement, smaller)
            if disagree(smaller):
                program = smaller
                break
        else:
            return program


def test_interpreter_agrees_with_the_rules() -> None:
    for number in range(SEED * COUNT, (SEED + 1) * COUNT):
        program = make_program(number)
        if disagree(program):
            program = shrink(program)
            printed, code, _ = outcome_by_the_rules(program)
            assert run_interpreter(program) == (printed, code), spell_program(program)


def test_random_programs_reach_far() -> None:
    """The programs neither all end early nor print nothing: else the test above tests nothing."""
    outcomes = [outcome_by_the_rules(make_program(number))[:2] for number in range(200)]
    ends = [code for _, code in outcomes]
    assert sum(len(printed) for printed, _ in outcomes) / len(outcomes) > 8
    assert ends.count(None) > len(ends) / 2
    assert {"undefined-name", "undefined-function"} <= set(ends)
