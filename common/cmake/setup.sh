# What tutorials/run, tests/run, tests/bless and .ci/run share: installing what is missing, configuring, building.
# Sourced by bash, never run. Messages go to stderr, so that a rung's own output can be piped on.

set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
me=$(cd "$(dirname "$0")" && pwd)/${0##*/}
me=${me#"$root/"} # how messages call the script: tutorials/run

# Debian's and Ubuntu's package names, and what each is for.
build_packages="
g++                     the C++20 compiler
cmake                   configures the build
ninja-build             runs the build
pkg-config              finds OpenImageIO and Dear ImGui
python3-glad            generates the OpenGL loader
libglfw3-dev            GLFW: windows
libimgui-dev            Dear ImGui: the settings panel
libglm-dev              GLM: vectors and matrices
libegl-dev              EGL: rendering without a window
libosmesa6              OSMesa: rendering without a window, in software
libgl1                  OpenGL itself, for the window
libegl1                 EGL itself
libgl1-mesa-dri         Mesa's drivers, llvmpipe among them
libopenimageio-dev      OpenImageIO: reads and writes images
libtinygltf-dev         tinygltf: reads glTF
libtinyobjloader-dev    tinyobjloader: reads OBJ
nlohmann-json3-dev      JSON
libcli11-dev            CLI11: the command line
"
test_packages="
libgtest-dev            GoogleTest
libfftw3-dev            FFTW: exact blurs to compare with
libopencolorio-dev      OpenColorIO: ACES to compare tone curves with
xvfb                    a display for the window test
xauth                   Xvfb's companion
xdotool                 presses the window's keys
x11-utils               asks the window for its state
imagemagick             takes and compares screenshots
valgrind                exact instruction counts
"

say() { printf '%s\n' "$*" >&2; }
fail() {
    say "$me: error: $*"
    exit 1
}

# requirePackages LIST: installs those of the list that are missing, where there is apt-get; elsewhere names them
# all once and goes on, because they may be there under other names.
requirePackages() {
    local list=$1 names missing
    if [ -z "$(type -P dpkg-query)" ] || [ -z "$(type -P apt-get)" ]; then
        [ -e "$build_dir/build.ninja" ] && return
        say "This is no Debian or Ubuntu, so nothing is installed here. Needed, by their names there:"
        say "$list"
        say "Trying to go on without installing."
        return
    fi
    names=$(awk 'NF { print $1 }' <<<"$list")
    # dpkg-query names what it has never heard of only on stderr, so ask for the installed and keep the rest.
    # shellcheck disable=SC2086
    missing=$({ dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' $names 2>/dev/null || true; } |
        awk -v names="$names" '$1 == "ii" || $1 == "hi" { there[$2] = 1 }
            END { n = split(names, name, "\n"); for (i = 1; i <= n; ++i) if (!(name[i] in there)) print name[i] }')
    [ -n "$missing" ] && installPackages "$list" "$missing"
    return 0
}

installPackages() {
    local list=$1 missing=$2 as_root=()
    say "These packages are missing and will be installed with apt-get:"
    while read -r name purpose; do
        if [ -n "$name" ] && grep -qxF -- "$name" <<<"$missing"; then say "  $(printf '%-22s' "$name") $purpose"; fi
    done <<<"$list"
    if [ "$(id -u)" != 0 ]; then
        [ -n "$(type -P sudo)" ] || fail "installing needs root and there is no sudo; run: apt-get install" $missing
        as_root=(sudo)
    fi
    local install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends)
    local update=("${as_root[@]}" apt-get update)
    # A fresh container has no package lists at all; old ones may name versions that are gone.
    if ! compgen -G '/var/lib/apt/lists/*Packages*' >/dev/null; then "${update[@]}" >&2; fi
    # shellcheck disable=SC2086
    "${install[@]}" $missing >&2 || { "${update[@]}" && "${install[@]}" $missing; } >&2 ||
        fail "apt-get could not install them all; the reason stands above"
}

# buildTargets PRESET TARGET...: configures build/PRESET where that was never done, then brings targets up to date.
# Says nothing when there is nothing to do.
buildTargets() {
    local preset=$1 log
    shift
    if [ ! -e "$build_dir/build.ninja" ]; then
        local options=()
        # Continuous integration also refuses warnings; a newer compiler's must not stop anybody else.
        if [ -n "${CI:-}" ]; then options=(-DGLLADDER_WERROR=ON); fi
        say "Configuring build/$preset"
        log=$(cd "$root" && cmake --preset "$preset" "${options[@]}" 2>&1) || {
            say "$log"
            fail "configuring build/$preset failed; the reason stands above"
        }
    fi
    if ninja -C "$build_dir" -n "$@" 2>/dev/null | grep -q 'no work to do'; then return; fi
    say "Building build/$preset"
    ninja -C "$build_dir" "$@" >&2 || fail "the build failed; the reason stands above"
}

# rungSummaries: one line a rung, its name and what its main.cpp says of it.
rungSummaries() {
    local main
    for main in "$root"/tutorials/[0-9][0-9]_*/main.cpp; do
        printf '  %-22s %s\n' "$(basename "$(dirname "$main")")" \
            "$(sed -nz 's/.*\.summary =[ \n]*"\([^"]*\)".*/\1/p' "$main" | tr -d '\0')"
    done
}

requireRung() {
    [ -e "$root/tutorials/$1/main.cpp" ] && return
    say "$me: error: there is no rung \"$1\"; the rungs are"
    rungSummaries >&2
    exit 2
}
