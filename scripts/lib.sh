# Shared by the scripts in this folder: finds Python and keeps a virtual environment up to date.
# Sourced, not run. POSIX sh.
#
#   PYTHON=python3.13 scripts/test    uses that interpreter, in an environment of its own

cd "$(dirname "$0")/.."
root=$PWD
# Tests and tools start hundreds of Pythons, which read compiled modules three times as quickly.
unset PYTHONDONTWRITEBYTECODE

say() { printf '%s\n' "$*" >&2; }
fail() { say "$*"; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }
is_recent() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 10))' >/dev/null 2>&1; }

# Print the interpreter to use: $PYTHON, else the first that is recent enough.
find_python() {
    if [ -n "${PYTHON:-}" ]; then
        is_recent "$PYTHON" || fail "PYTHON=$PYTHON is not a Python 3.10 or newer"
        printf '%s\n' "$PYTHON"
        return
    fi
    for candidate in python3 python3.14 python3.13 python3.12 python3.11 python3.10 python; do
        if is_recent "$candidate"; then
            printf '%s\n' "$candidate"
            return
        fi
    done
    fail "Yamaro needs Python 3.10 or newer; install it, or name it: PYTHON=/path/to/python3.12 $0"
}

# Install Debian packages if this machine has apt and lets us; say so, and fail quietly otherwise.
apt_install() {
    have apt-get || return 1
    if [ "$(id -u)" -eq 0 ]; then sudo=; elif have sudo && sudo -n true 2>/dev/null; then sudo=sudo; else return 1; fi
    say "installing $*"
    $sudo apt-get install -y -qq "$@" >/dev/null 2>&1 ||
        { $sudo apt-get update -qq && $sudo apt-get install -y -qq "$@"; } >/dev/null 2>&1
}

# What OpenGL needs to draw in software, without a display.
opengl='libegl1 libgl1-mesa-dri'
draws() { python -c 'from yamaro.picture.stage import make_window; make_window()' >/dev/null 2>&1; }

make_venv() {
    "$1" -m venv "$2" >/dev/null 2>&1 && return
    # Debian keeps the venv module in a package of its own, which scripts/setup-judges installs.
    fail "could not make a virtual environment with '$1 -m venv'; on Debian: apt install python3-venv"
}

plain_pip_install() { "$venv/bin/python" -m pip install -q --disable-pip-version-check "$@"; }

# Print the path of uv, which takes a fifth of pip's time: of the one there is, else of one made in $venv.
find_uv() {
    for uv in uv "$root/.venv/bin/uv" "$venv/bin/uv"; do
        if have "$uv"; then
            printf '%s\n' "$uv"
            return
        fi
    done
    plain_pip_install uv >/dev/null 2>&1 && printf '%s\n' "$venv/bin/uv"
}

export UV_SYSTEM_CERTS=true # as pip does

# Install into $venv: with uv; with pip where there is no uv, or where it does not get the packages.
pip_install() {
    if uv=$(find_uv) && "$uv" pip install -q --python "$venv/bin/python" "$@"; then return; fi
    "$venv/bin/python" -m ensurepip >/dev/null 2>&1 || true
    # Older ones, such as Debian 12's, search for minutes before they settle on versions.
    plain_pip_install 'pip>=24.1'
    plain_pip_install "$@"
}

# use_venv NAME EXTRAS: make NAME/ (once) with the project and its EXTRAS in it, and put it on PATH.
# With PYTHON the name gets the version too. A copy of pyproject.toml inside tells whether the
# environment still holds what the project asks for.
use_venv() {
    name=$1
    if [ -n "${PYTHON:-}" ]; then
        python=$(find_python)
        name=$1-$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    fi
    venv=$root/$name
    stamp=$venv/pyproject-${2:-none}.toml
    if [ ! -x "$venv/bin/python" ] || ! is_recent "$venv/bin/python"; then
        python=$(find_python)
        say "making $name with $("$python" --version)"
        make_venv "$python" "$venv"
    fi
    if ! cmp -s pyproject.toml "$stamp"; then
        say "installing Yamaro${2:+ with its $2 tools} into $name"
        pip_install -e ".${2:+[$2]}"
        cp pyproject.toml "$stamp"
    fi
    PATH=$venv/bin:$PATH
    export PATH
}
