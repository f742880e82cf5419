"""Makes completion scripts for shells, and lists the variables that a file lets one set.

The scripts ask the command for the variables of the file on the command line. Only the YAML is
read for that: no expression is evaluated and nothing is imported.
"""

from __future__ import annotations

import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..syntax.yaml_nodes import YamlNode

SHELLS = ("bash", "zsh", "fish")
PICTURE_OPTIONS = (
    "--size", "--view", "--joints", "--show", "--transparent", "--turn", "--sweep", "--seconds",
    "--frames-per-second",
)  # fmt: skip
"""The options of `yamaro picture` alone."""
VALUED = (
    "-o", "--output", "--color", "--timeout", "--allow-path", "--limit", "--package", "--port",
    "--editor", "--size", "--view", "--joints", "--show", "--sweep", "--seconds",
    "--frames-per-second",
)  # fmt: skip
"""The options with a word behind them."""
MAX_BYTES = 8 << 20
MAX_DEFAULT = 40


def script(shell: str) -> str:
    """Return the completion script for one of `SHELLS`."""
    from ..policy import limit_names
    from .picture.words import NAMED_VIEWS, SHOWN

    text = {"bash": _BASH, "zsh": _ZSH, "fish": _FISH}[shell]
    words = {
        "@LIMITS@": " ".join(limit_names()),
        "@PICTURE@": " ".join(PICTURE_OPTIONS),
        "@SHOWN@": " ".join(SHOWN),
        "@VALUED@": " | ".join(VALUED),
        "@VALUED_WORDS@": " ".join(VALUED),
        "@VIEWS@": " ".join(NAMED_VIEWS),
    }
    for mark, replacement in words.items():
        text = text.replace(mark, replacement)
    return text


def variable_lines(path: str) -> str:
    """Return a line `name:=<tab>default` for each variable in the root of a file.

    A file that cannot be read has none: someone who is still typing wants no errors.
    """
    from ..diagnostics import Reporter, YamaroError
    from ..source import Source
    from ..syntax.yaml_reader import read
    from ..terminal import printable

    if path.startswith("~"):
        path = os.path.expanduser(path)
    try:
        if not os.path.isfile(path) or os.path.getsize(path) > MAX_BYTES:
            return ""
        with open(path, encoding="utf-8-sig", newline="") as file:
            root = read(Source(file.read(), name=path), reporter=Reporter())
    except (OSError, UnicodeDecodeError, YamaroError):
        return ""
    lines: dict[str, str] = {}
    for section, body in _pairs(root):
        if section == "variables":
            for key, value in _pairs(body):
                name = key.partition("/")[0].strip()
                if name.isidentifier():
                    lines.setdefault(name, printable(_shortened(value)).replace("\t", " "))
    return "".join(f"{name}:=\t{default}\n" for name, default in lines.items())


def _pairs(node: YamlNode) -> Iterator[tuple[str, YamlNode]]:
    """Yield key text and value of a mapping, or of each mapping in a list of them."""
    from ..syntax.yaml_nodes import MappingNode, SequenceNode

    if isinstance(node, SequenceNode):
        for item in node.items:
            if isinstance(item, MappingNode):
                yield from _pairs(item)
    elif isinstance(node, MappingNode):
        for key, value in node:
            yield key.text, value


def _shortened(value: YamlNode) -> str:
    """Return the spelling of a value on one short line."""
    text = " ".join(value.source.text[value.start : value.end].split())
    return text if len(text) <= MAX_DEFAULT else text[: MAX_DEFAULT - 1] + "…"


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
            check | tree | view | watch | picture | migrate | completion)
                if [[ $command$file ]]; then file=${file:-$word}; else command=$word; fi ;;
            *) file=${file:-$word} ;;
        esac
    done
    COMPREPLY=()
    case ${words[last]} in *:=* | --limit=*=*) return ;; esac
    if [[ ${words[last - 1]} == --limit && ${words[last]} == *=* ]]; then return; fi
    if [[ $previous == = ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi
    if [[ $current == = ]]; then current=; previous=${COMP_WORDS[COMP_CWORD - 1]}; fi
    case $previous in
        --color) COMPREPLY=($(compgen -W "auto always never" -- "$current")); return ;;
        -o | --output | --allow-path) _yamaro_files "$current" ""; return ;;
        --package | --timeout | --port) return ;;
        --size | --joints | --sweep | --seconds | --frames-per-second) return ;;
        --view) COMPREPLY=($(compgen -W "@VIEWS@" -- "$current")); return ;;
        --show) COMPREPLY=($(compgen -W "@SHOWN@" -- "$current")); return ;;
        --editor) COMPREPLY=($(compgen -c -- "$current")); return ;;
        --limit)
            COMPREPLY=($(compgen -W "@LIMITS@" -S = -- "$current"))
            compopt -o nospace 2>/dev/null
            return ;;
    esac
    if [[ $command == completion ]]; then
        COMPREPLY=($(compgen -W "bash zsh fish" -- "$current"))
    elif [[ $current == -* ]]; then
        local options="-q --quiet --strict --color"
        options+=" --trust --jail --safe --timeout --allow-path --limit --package"
        [[ $command == migrate ]] && options="-q --quiet --color --limit -o --output --force"
        [[ $command == view ]] && options+=" --port --no-browser --editor"
        [[ $command == watch ]] && options+=" -o --output"
        [[ $command == picture ]] && options+=" -o --output @PICTURE@"
        [[ $command ]] || options+=" -o --output --deps -h --help -V --version"
        COMPREPLY=($(compgen -W "$options" -- "$current"))
    elif [[ $file ]]; then
        local names
        names=$(yamaro completion variables "${file/#\~\//$HOME/}" 2>/dev/null | cut -f 1)
        COMPREPLY=($(compgen -W "$names" -- "$current"))
        compopt -o nospace 2>/dev/null
    else
        local commands="check tree view watch picture migrate completion"
        [[ $command ]] || COMPREPLY=($(compgen -W "$commands" -- "$current"))
        if [[ $command == migrate ]]; then
            _yamaro_files "$current" urdf xml
        elif [[ $command ]]; then
            _yamaro_files "$current" yaml yml urdf xacro
        else
            _yamaro_files "$current" yaml yml
        fi
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
            check | tree | view | watch | picture | migrate | completion)
                if [[ -n $command$file ]]; then file=${file:-$word}; else command=$word; fi ;;
            *) file=${file:-$word} ;;
        esac
    done
    if [[ $command == completion ]]; then
        compadd bash zsh fish
    elif [[ -n $file ]]; then
        [[ $PREFIX == *:=* ]] && return 1
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
                'check:look for errors, warnings and doubtful things'
                'tree:show links, joints and masses as a tree'
                'view:show the robot in the browser, anew at each save'
                'watch:compile at each save'
                'picture:draw the robot'
                'migrate:write a URDF as a YAML file'
                'completion:print a completion script'
            )
            _describe -t commands command commands
        fi
        if [[ $command == migrate ]]; then
            _files -g '*.(urdf|xml)(-.)'
        elif [[ -n $command ]]; then
            _files -g '*.(yaml|yml|urdf|xacro)(-.)'
        else
            _files -g '*.(yaml|yml)(-.)'
        fi
    fi
}

_yamaro_limits() {
    [[ $PREFIX == *=* ]] || compadd -S = @LIMITS@
}

_yamaro() {
    _arguments -s -S \
        '(-o --output)'{-o+,--output=}'[write to FILE]:output file:_files' \
        '(-q --quiet)'{-q,--quiet}'[show errors only]' \
        '--strict[treat warnings as errors]' \
        '--deps[list the files read and the meshes used]' \
        '(--jail --safe)--trust[let the file do whatever Python can]' \
        '(--trust --safe)--jail[let it read its own folder, and write nothing]' \
        '(--trust --jail)--safe[let it do nothing but compute]' \
        '--timeout=[end it after that time]:seconds: ' \
        '*--allow-path=[let it read a file or folder]:file or folder:_files' \
        '*--limit=[set how much it may use]:limit:_yamaro_limits' \
        '*--package=[say where a ROS package is]:name\:=folder: ' \
        '--force[with migrate, replace a file]' \
        '--port=[with view, serve the page at that port]:port: ' \
        '--no-browser[with view, only print the address]' \
        '--editor=[with view, open files with that command]:command:_command_names -e' \
        '--size=[with picture, its width and height]:pixels: ' \
        '*--view=[with picture, from where]:view:(@VIEWS@)' \
        '*--joints=[with picture, where joints stand]:name=position: ' \
        '*--show=[with picture, what is shown]:what:(@SHOWN@)' \
        '--transparent[with picture, nothing behind the robot]' \
        '--turn[with picture, a film all around the robot]' \
        '--sweep=[with picture, a film of moving joints]:joints:(all each)' \
        '--seconds=[with picture, how long a film is]:seconds: ' \
        '--frames-per-second=[with picture, how quick a film is]:frames: ' \
        '--color=[colour messages]:when:(auto always never)' \
        '(- *)'{-h,--help}'[show help]' \
        '(- *)'{-V,--version}'[show the version]' \
        '*: :_yamaro_words'
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
    contains -- "$words[1]" check tree view watch picture migrate completion; and echo $words[1]
end

function __yamaro_file
    set -l words (__yamaro_words)
    contains -- "$words[1]" check tree view watch picture migrate completion; and set -e words[1]
    test -n "$words[1]"; and echo -- $words[1]
end

function __yamaro_variables
    string match -q '*:=*' -- (commandline -ct); and return
    set -l file (__yamaro_file | string replace -r '^~/' "$HOME/")
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
        case file
            test "$command" != completion -a -z "$file"
        case variable
            test "$command" != completion -a -n "$file"
    end
end

complete -c yamaro -f
complete -c yamaro -n '__yamaro_wants command' -a check -d 'look for errors and warnings'
complete -c yamaro -n '__yamaro_wants command' -a tree -d 'show links, joints and masses'
complete -c yamaro -n '__yamaro_wants command' -a view -d 'show the robot in the browser'
complete -c yamaro -n '__yamaro_wants command' -a watch -d 'compile at each save'
complete -c yamaro -n '__yamaro_wants command' -a picture -d 'draw the robot'
complete -c yamaro -n '__yamaro_wants command' -a migrate -d 'write a URDF as a YAML file'
complete -c yamaro -n '__yamaro_wants command' -a completion -d 'print a completion script'
complete -c yamaro -n '__yamaro_wants shell' -a 'bash zsh fish'
complete -c yamaro -n '__yamaro_wants file' -k -a '(__fish_complete_suffix .yaml)'
complete -c yamaro -n '__yamaro_wants variable' -k -a '(__yamaro_variables)'
complete -c yamaro -s o -l output -r -F -d 'write to FILE'
complete -c yamaro -s q -l quiet -d 'show errors only'
complete -c yamaro -l strict -d 'treat warnings as errors'
complete -c yamaro -l deps -d 'list the files read and the meshes used'
complete -c yamaro -l trust -d 'let the file do whatever Python can'
complete -c yamaro -l jail -d 'let it read its own folder, and write nothing'
complete -c yamaro -l safe -d 'let it do nothing but compute'
complete -c yamaro -l timeout -x -d 'end it after so many seconds'
complete -c yamaro -l allow-path -r -F -d 'let it read a file or folder'
complete -c yamaro -l limit -x -a '(string split " " "@LIMITS@")=' -d 'set how much it may use'
complete -c yamaro -l package -x -d 'say where a ROS package is: NAME:=FOLDER'
complete -c yamaro -l force -d 'with migrate, replace a file'
complete -c yamaro -l port -x -d 'with view, serve the page at that port'
complete -c yamaro -l no-browser -d 'with view, only print the address'
complete -c yamaro -l editor -x -a '(__fish_complete_command)' -d 'with view, open files with that'
complete -c yamaro -l size -x -d 'with picture, its width and height'
complete -c yamaro -l view -x -a '@VIEWS@' -d 'with picture, from where'
complete -c yamaro -l joints -x -d 'with picture, where joints stand: NAME=POSITION'
complete -c yamaro -l show -x -a '@SHOWN@' -d 'with picture, what is shown'
complete -c yamaro -l transparent -d 'with picture, nothing behind the robot'
complete -c yamaro -l turn -d 'with picture, a film all around the robot'
complete -c yamaro -l sweep -x -a 'all each' -d 'with picture, a film of moving joints'
complete -c yamaro -l seconds -x -d 'with picture, how long a film is'
complete -c yamaro -l frames-per-second -x -d 'with picture, how quick a film is'
complete -c yamaro -l color -x -a 'auto always never' -d 'colour messages'
complete -c yamaro -s h -l help -d 'show help'
complete -c yamaro -s V -l version -d 'show the version'
"""
