"""`yamaro completion`: completion scripts of shells, and the answers to them.

The scripts are made from the tables of commands and options. They ask the command for the variables
of the file on the command line, which is only read for that.
"""

from __future__ import annotations

import os

from .command_table import BUILD, all_commands, named_commands
from .option_table import OPTIONS, all_options, options_of
from .reports import WrongUsage, deliver

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..declared_arguments import Declared
    from ..streams import Streams
    from .arguments import Arguments
    from .option_table import Option

SHELLS = ("bash", "zsh", "fish")


def script(shell: str) -> str:
    """Return the completion script for one of `SHELLS`."""
    template, words = {"bash": (_BASH, _bash), "zsh": (_ZSH, _zsh), "fish": (_FISH, _fish)}[shell]
    valued = [spelling for one in all_options().values() if one.value for spelling in one.spellings]
    marks = {
        "@COMMANDS@": " ".join(named_commands()),
        "@COMMANDS_CASE@": " | ".join(named_commands()),
        "@SHELLS@": " ".join(SHELLS),
        "@VALUED@": " | ".join(valued),
        "@VALUED_WORDS@": " ".join(valued),
        **words(),
        "@LIMITS@": _offered(OPTIONS["limit"]),
    }
    text = template
    for mark, replacement in marks.items():
        text = text.replace(mark, replacement)
    return text


def _offered(option: Option) -> str:
    """Return the words that a shell offers as the value of an option."""
    from ..codes import ADJUSTABLE
    from ..policy import limit_names
    from ..targets.table import TARGETS

    tables = {"limits": limit_names(), "codes": sorted(ADJUSTABLE), "formats": list(TARGETS)}
    return " ".join(tables.get(option.completes, [option.completes]))


def _briefly(option: Option) -> str:
    """Return what an option does in a few words, with the command if that is not the usual one."""
    text = option.help
    for mark in (";", ":", " ("):
        text = text.partition(mark)[0]
    names = [name for name, each in all_commands().items() if option in options_of(each)]
    return text if BUILD in names else f"with {', '.join(names)}, {text}"


def _bash() -> dict[str, str]:
    plain: list[str] = []
    values = ""
    for option in all_options().values():
        spellings = " | ".join(option.spellings)
        if option.completes == "files":
            action = '_yamaro_files "$current" ""'
        elif option.completes == "commands":
            action = 'COMPREPLY=($(compgen -c -- "$current"))'
        elif option.completes:
            action = f'COMPREPLY=($(compgen -W "{_offered(option)}" -- "$current"))'
        else:
            plain += option.spellings if option.value else ()
            continue
        if option.completes != "limits":  # which have a case of their own
            values += f"        {spellings}) {action}; return ;;\n"
    values += f"        {' | '.join(plain)}) return ;;\n"
    options = endings = ""
    for name, command in all_commands().items():
        words = " ".join(word for option in options_of(command) for word in option.spellings)
        options += f'            {name}) options="{words}" ;;\n'
        if command.endings:
            endings += (
                f'            {name}) _yamaro_files "$current" {" ".join(command.endings)} ;;\n'
            )
    return {"@VALUES@": values, "@OPTIONS@": options, "@ENDINGS@": endings}


def _zsh() -> dict[str, str]:
    options = described = endings = ""
    for option in all_options().values():
        text = _briefly(option).replace("]", "\\]").replace("'", "'\\''")
        value = option.value.lower().replace(":", "\\:")
        action = {"": " ", "files": "_files", "commands": "_command_names -e"}.get(
            option.completes, f"({_offered(option)})"
        )
        if option.completes == "limits":
            action = "_yamaro_limits"
        end = f"'[{text}]{f':{value}:{action}' if value else ''}'"
        equals = "=" if value else ""
        if option.name in ("help", "version"):  # nothing else has a meaning with them
            start = "'(- *)'"
        elif option.is_repeatable:
            start = "'*'"
        else:
            others = [f"--{other}" for other in option.excludes]
            start = f"'({' '.join([*option.spellings, *others])})'"
        if option.short:
            start += f"{{-{option.short}{'+' if value else ''},--{option.name}{equals}}}"
        else:
            start += f"--{option.name}{equals}"
        options += f"        {start}{end} \\\n"
    for name, command in all_commands().items():
        if name != BUILD:
            described += f"                '{name}:{command.summary}'\n"
        if command.endings:
            pattern = "|".join(command.endings)
            endings += f"            {name}) _files -g '*.({pattern})(-.)' ;;\n"
    return {"@OPTIONS@": options, "@DESCRIBED@": described, "@ENDINGS@": endings}


def _fish() -> dict[str, str]:
    described = options = ""
    for name, command in all_commands().items():
        if name != BUILD:
            wants = "complete -c yamaro -n '__yamaro_wants command'"
            described += f"{wants} -a {name} -d '{command.summary}'\n"
    for option in all_options().values():
        line = "complete -c yamaro" + (f" -s {option.short}" if option.short else "")
        line += f" -l {option.name}"
        if option.completes == "files":
            line += " -r -F"
        elif option.completes == "commands":
            line += " -x -a '(__fish_complete_command)'"
        elif option.completes == "limits":
            line += ' -x -a \'(string split " " "@LIMITS@")=\''
        elif option.completes:
            line += f" -x -a '{_offered(option)}'"
        elif option.value:
            line += " -x"
        text = _briefly(option).replace("'", "\\'")
        options += f"{line} -d '{text}'\n"
    return {"@OPTIONS@": options, "@DESCRIBED@": described}


_BASH = r"""# bash completion for yamaro; put this in ~/.bashrc:  eval "$(yamaro completion bash)"

_yamaro() {
    local IFS=$' \t\n' current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    local typed=${COMP_LINE:0:COMP_POINT} command= file= skip= word last
    local -a words
    read -ra words <<<"$typed"
    [[ $typed == *[[:space:]] ]] && words+=("")
    last=$((${#words[@]} - 1))
    for word in "${words[@]:1:last-1}"; do
        if [[ $skip ]]; then skip=; continue; fi
        case $word in
            @VALUED@) skip=1 ;;
            -?* | *:=*) ;;
            @COMMANDS_CASE@)
                if [[ $command$file ]]; then file=${file:-$word}; else command=$word; fi ;;
            *) file=${file:-$word} ;;
        esac
    done
    COMPREPLY=()
    case ${words[last]} in
        --limit=*=*) return ;;
        *:=*)
            local values before= name=${words[last]%%:=*}
            values=$(yamaro completion values "${file/#\~\//$HOME/}" "$name" 2>/dev/null)
            [[ $COMP_WORDBREAKS == *=* ]] || before=$name:=
            COMPREPLY=($(compgen -P "$before" -W "$values" -- "${words[last]#*:=}"))
            return ;;
    esac
    if [[ ${words[last - 1]} == --limit && ${words[last]} == *=* ]]; then return; fi
    if [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi
    if [[ $current == = ]]; then current=; previous=${COMP_WORDS[COMP_CWORD - 1]}; fi
    case $previous in
@VALUES@        --limit)
            COMPREPLY=($(compgen -W "@LIMITS@" -S = -- "$current"))
            compopt -o nospace 2>/dev/null
            return ;;
    esac
    if [[ $command == completion ]]; then
        COMPREPLY=($(compgen -W "@SHELLS@" -- "$current"))
    elif [[ $command == help ]]; then
        COMPREPLY=($(compgen -W "@COMMANDS@" -- "$current"))
    elif [[ $current == -* ]]; then
        local options
        case ${command:-build} in
@OPTIONS@        esac
        COMPREPLY=($(compgen -W "$options" -- "$current"))
    elif [[ $file ]]; then
        local names
        names=$(yamaro completion variables "${file/#\~\//$HOME/}" 2>/dev/null | cut -f 1)
        COMPREPLY=($(compgen -W "$names" -- "$current"))
        compopt -o nospace 2>/dev/null
    else
        [[ $command ]] || COMPREPLY=($(compgen -W "@COMMANDS@" -- "$current"))
        case ${command:-build} in
@ENDINGS@        esac
    fi
}

# Add the folders, and the files with one of the endings, that begin with $1.
_yamaro_files() {
    local IFS=$'\n' current=$1 ending
    shift
    COMPREPLY+=($(compgen -d -- "$current"))
    for ending in "$@"; do
        if [[ $ending ]]; then
            COMPREPLY+=($(compgen -f -X "!*.$ending" -- "$current"))
        else
            COMPREPLY=($(compgen -f -- "$current"))
        fi
    done
    compopt -o filenames 2>/dev/null
}

complete -F _yamaro yamaro
"""

_ZSH = r"""#compdef yamaro
# zsh completion for yamaro; put this in ~/.zshrc after compinit:  eval "$(yamaro completion zsh)"

_yamaro_words() {
    local word skip command file
    for word in "${(@)words[2,CURRENT-1]}"; do
        if [[ -n $skip ]]; then skip=; continue; fi
        case $word in
            @VALUED@) skip=1 ;;
            -?* | *:=*) ;;
            @COMMANDS_CASE@)
                if [[ -n $command$file ]]; then file=${file:-$word}; else command=$word; fi ;;
            *) file=${file:-$word} ;;
        esac
    done
    if [[ $command == completion ]]; then
        compadd @SHELLS@
    elif [[ $command == help ]]; then
        compadd @COMMANDS@
    elif [[ -n $file ]]; then
        if [[ $PREFIX == *:=* ]]; then
            local name=${PREFIX%%:=*} source=${(Q)file/#\~\//$HOME/}
            local -a values=("${(@f)$(yamaro completion values "$source" "$name" 2>/dev/null)}")
            compset -P '*:='
            compadd -a values
            return
        fi
        local -a names described
        local name default
        yamaro completion variables "${(Q)file/#\~\//$HOME/}" 2>/dev/null |
            while IFS=$'\t' read -r name default; do
                names+=("$name")
                described+=("$name $default")
            done
        compadd -S '' -l -d described -a names
    else
        if [[ -z $command ]]; then
            local -a commands=(
@DESCRIBED@            )
            _describe -t commands command commands
        fi
        case ${command:-build} in
@ENDINGS@        esac
    fi
}

_yamaro_limits() {
    [[ $PREFIX == *=* ]] || compadd -S = @LIMITS@
}

_yamaro() {
    _arguments -s -S \
@OPTIONS@        '*: :_yamaro_words'
}

if [[ ${funcstack[1]} == _yamaro ]]; then _yamaro "$@"; else compdef _yamaro yamaro; fi
"""

_FISH = r"""# fish completion for yamaro; put this in ~/.config/fish/completions/yamaro.fish

# Print the words before the cursor that are neither options nor variables: command and file.
function __yamaro_words
    set -l skip 0
    set -l words (commandline -opc)
    for word in $words[2..-1]
        if test $skip = 1
            set skip 0
            continue
        end
        switch $word
            case @VALUED_WORDS@
                set skip 1
            case '-?*' '*:=*'
            case '*'
                echo -- $word
        end
    end
end

function __yamaro_command
    set -l words (__yamaro_words)
    contains -- "$words[1]" @COMMANDS@; and echo $words[1]
end

function __yamaro_file
    set -l words (__yamaro_words)
    contains -- "$words[1]" @COMMANDS@; and set -e words[1]
    test -n "$words[1]"; and echo -- $words[1]
end

function __yamaro_variables
    set -l file (__yamaro_file | string replace -r '^~/' "$HOME/")
    set -l typed (commandline -ct)
    if string match -q '*:=*' -- $typed
        set -l name (string replace -r ':=.*' '' -- $typed)
        for value in (yamaro completion values $file $name 2>/dev/null)
            echo -- $name:=$value
        end
        return
    end
    yamaro completion variables $file 2>/dev/null
end

function __yamaro_wants
    set -l command (__yamaro_command)
    set -l file (__yamaro_file)
    switch "$argv[1]"
        case command
            test -z "$command$file"
        case shell
            test "$command" = completion
        case topic
            test "$command" = help
        case file
            not contains -- "$command" completion help; and test -z "$file"
        case variable
            not contains -- "$command" completion help; and test -n "$file"
    end
end

complete -c yamaro -f
@DESCRIBED@complete -c yamaro -n '__yamaro_wants shell' -a '@SHELLS@'
complete -c yamaro -n '__yamaro_wants topic' -a '@COMMANDS@'
complete -c yamaro -n '__yamaro_wants file' -k -a '(__fish_complete_suffix .yaml)'
complete -c yamaro -n '__yamaro_wants variable' -k -a '(__yamaro_variables)'
@OPTIONS@"""


# --- what a file lets one set, and to which values --------------------------------------------


MAX_BYTES = 8 << 20
MAX_DEFAULT = 40


def variable_lines(path: str) -> str:
    """Return a line `name:=<tab>default, what else is known` for each argument or variable."""
    from ..declared_arguments import about
    from ..terminal import printable

    lines = []
    for declared in _declared(path):
        default = " ".join((declared.default_text or "").split())
        if len(default) > MAX_DEFAULT:
            default = default[: MAX_DEFAULT - 1] + "…"
        notes = ", ".join(text for text in (default, about(declared)) if text)
        lines.append(f"{declared.name}:=\t{printable(notes).replace(chr(9), ' ')}\n")
    return "".join(lines)


def value_lines(path: str, name: str) -> str:
    """Return a line for each value of an argument or variable that has a few: choices, or a truth.

    Values that a shell would take apart are left out.
    """
    from ..syntax.argument_section import BOOLEAN

    for declared in [each for each in _declared(path) if each.name == name][:1]:
        entry = declared.entry
        values: list[str] = []
        if entry is not None and entry.choices is not None:
            values = entry.choice_texts()
        elif isinstance(declared.default, bool) if entry is None else entry.kind == BOOLEAN:
            values = ["true", "false"]
        words = [each for each in values if all(c.isalnum() or c in "_-+./" for c in each)]
        return "".join(f"{word}\n" for word in words)
    return ""


def _declared(path: str) -> list[Declared]:
    """Return what a file declares.

    A file that cannot be read has nothing: someone who is still typing wants no errors.
    """
    from ..declared_arguments import listing_of
    from ..diagnostics import YamaroError
    from ..files.loader import FileLoader
    from ..files.packages import PackageFinder
    from ..files.regular import read_start
    from ..policy import Limits
    from ..source import Source, holds_xml
    from ..xml.reader import decode_xml

    if path.startswith("~"):
        path = os.path.expanduser(path)
    limits = Limits()
    try:
        data = read_start(path, MAX_BYTES + 1)
        if len(data) > MAX_BYTES:
            return []
        absolute = os.path.abspath(path)
        if holds_xml(path, data):
            source = decode_xml(data, name=path, path=absolute)
            source.is_xml = True
        else:
            source = Source(data.decode("utf-8-sig"), name=path, path=absolute)
        loader = FileLoader(limits)
        listing = listing_of(source, loader=loader, packages=PackageFinder(), limits=limits)
    except (OSError, ValueError, YamaroError):
        return []
    return listing.declared


# --- the command ------------------------------------------------------------------------------


def run(arguments: Arguments, streams: Streams) -> int:
    """Write the script of a shell, or variables or values of a file; return the exit status."""
    words = arguments.words
    if len(words) == 2 and words[0] == "variables":
        text = variable_lines(words[1])
    elif len(words) == 3 and words[0] == "values":
        text = value_lines(words[1], words[2])
    elif len(words) == 1 and words[0] in SHELLS:
        text = script(words[0])
    else:
        raise WrongUsage(f"'yamaro completion' needs a shell: {', '.join(SHELLS)}")
    return deliver([text], arguments, streams)
