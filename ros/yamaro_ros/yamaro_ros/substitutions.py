"""`Yamaro` in Python launch files, and `$(yamaro FILE name:=value)` in those of XML and YAML."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from launch import LaunchContext, SomeSubstitutionsType, Substitution
from launch.frontend import expose_substitution
from launch.logging import get_logger
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

from .robots import PACKAGES, RobotError, build_robot, split_words

FLAGS: dict[str, dict[str, object]] = {
    "--trust": {"trust": "trust"},
    "--jail": {"trust": "jail"},
    "--safe": {"trust": "safe"},
    "--gazebo": {"gazebo": True},
    "--strict": {"strict": True},
}
"""What a word without a value changes."""
VALUES = {"--to": "target", "--meshes": "meshes"}
"""The option that a word gives the next word to."""


@expose_substitution("yamaro")
class Yamaro(Substitution):  # type: ignore[misc]
    """A robot, compiled in the process of `ros2 launch` when the substitution is performed.

    Its warnings and what it prints go to launch's logger `yamaro`. An error ends the launch, with a
    message that shows the file, the line and a hint.
    """

    def __init__(
        self,
        path: SomeSubstitutionsType,
        variables: Mapping[str, object] | None = None,
        *,
        arguments: SomeSubstitutionsType = "",
        words: Iterable[SomeSubstitutionsType] = (),
        trust: str = "trust",
        target: str = "urdf",
        meshes: str = PACKAGES,
        gazebo: bool = False,
        strict: bool = False,
    ) -> None:
        """Describe a robot.

        Args:
            path: the file: YAML, URDF or xacro.
            variables: variables by name. A substitution, or a list with one in it, is read as on
                the command line, so that `0.5` is a number; all other values are taken as they are.
            arguments: a part of a command line, which is split as a shell does.
            words: the same, each a word: `name:=value`, or an option such as `--safe`.
            trust: `trust`, `jail` or `safe`.
            target: `urdf`, `sdf` or `srdf`.
            meshes: how meshes are named, by default as `package://NAME/…`; see `yamaro.build`.
            gazebo: also write the sensors and the surfaces of collisions for Gazebo.
            strict: warnings are errors.
        """
        super().__init__()
        self._path = normalize_to_list_of_substitutions(path)
        self._variables = dict(variables or {})
        self._arguments = normalize_to_list_of_substitutions(arguments)
        self._words = [normalize_to_list_of_substitutions(word) for word in words]
        self._options: dict[str, object] = {
            "trust": trust, "target": target, "meshes": meshes, "gazebo": gazebo, "strict": strict,
        }  # fmt: skip

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Yamaro], dict[str, object]]:
        """Return what to create for `$(yamaro FILE name:=value …)`."""
        if not data:
            raise ValueError("$(yamaro) needs a file: $(yamaro robot.yaml 'name:=value')")
        return cls, {"path": data[0], "words": data[1:]}

    def describe(self) -> str:
        """Return what launch shows of it."""
        return f"Yamaro({' + '.join(part.describe() for part in self._path)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the robot.

        Raises:
            SubstitutionFailure: there is none; the message shows why, and where.
        """
        logger = get_logger("yamaro")
        path = perform_substitutions(context, self._path)
        try:
            assignments, options = self._read(context)
            build = build_robot(
                path,
                words=assignments,
                variables=self._plain_variables(),
                warn=logger.warning,
                inform=logger.info,
                **{**self._options, **options},  # type: ignore[arg-type]
            )
        except RobotError as error:
            raise SubstitutionFailure(f"{path} cannot be built:\n{error}") from None
        return build.xml()

    def _read(self, context: LaunchContext) -> tuple[list[str], dict[str, object]]:
        """Return the `name:=value` of all words, and what the options among them change."""
        words = split_words(perform_substitutions(context, self._arguments))
        words += [perform_substitutions(context, word) for word in self._words]
        words += [
            f"{name}:={perform_substitutions(context, normalize_to_list_of_substitutions(value))}"
            for name, value in self._variables.items()
            if _has_substitution(value)
        ]
        return split_options(words)

    def _plain_variables(self) -> dict[str, object]:
        return {
            name: value for name, value in self._variables.items() if not _has_substitution(value)
        }


def _has_substitution(value: object) -> bool:
    if isinstance(value, (list, tuple)):
        return any(isinstance(item, Substitution) for item in value)
    return isinstance(value, Substitution)


def split_options(words: Iterable[str]) -> tuple[list[str], dict[str, object]]:
    """Return the words that set variables, and what the options among them change.

    Raises:
        RobotError: a word is neither.
    """
    assignments: list[str] = []
    options: dict[str, object] = {}
    remaining = iter(words)
    for word in remaining:
        name, has_value, value = word.partition("=")
        if name in VALUES:
            value = value if has_value else next(remaining, "")
            if not value:
                raise RobotError(f"'{name}' needs a value")
            options[VALUES[name]] = value
        elif word in FLAGS:
            options.update(FLAGS[word])
        elif ":=" in word:
            assignments.append(word)
        elif word:
            known = ", ".join((*FLAGS, *VALUES))
            raise RobotError(f"'{word}' is neither name:=value nor an option; options: {known}")
    return assignments, options
