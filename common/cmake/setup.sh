# What tutorials/run, tutorials/add, tests/run, tests/bless, tests/fresh and .ci/run share: installing what is missing,
# configuring, building.
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
libopengl-dev           OpenGL's library, which CMake asks for beside EGL's
libosmesa6              OSMesa: rendering without a window, in software; EGL does where Mesa no longer has it
libgl1                  OpenGL itself, for the window
libegl1                 EGL itself
libgl1-mesa-dri         Mesa's drivers, llvmpipe among them
libopenimageio-dev      OpenImageIO: reads and writes images
libpng-dev              libpng: reads and writes PNGs
zlib1g-dev              zlib: whether the rows of an EXR are whole
libtinyobjloader-dev    tinyobjloader: reads OBJ
nlohmann-json3-dev      JSON
libcli11-dev            CLI11: the command line
libcpp-httplib-dev      cpp-httplib: frame_check's page for reviews
"
test_packages="
libgtest-dev            GoogleTest
libfftw3-dev            FFTW: exact blurs to compare with
libembree-dev           Embree: rays, to compare shadows with
libopencolorio-dev      OpenColorIO: ACES to compare tone curves with
locales                 German, whose numbers have a comma
xvfb                    a display for the window test
xauth                   Xvfb's companion
xdotool                 presses the window's keys
x11-xserver-utils       sets the display's scale
x11-utils               asks the window for its state
imagemagick             takes and compares screenshots
valgrind                exact instruction counts
gnuplot-nox             draws charts
tachyon-bin-nox         a ray tracer, to check frames of
gstreamer1.0-gl         draws by OpenGL, to check frames of
gstreamer1.0-tools      runs it
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
    if hasPackageLists; then missing=$(withoutGone "$missing"); fi
    [ -n "$missing" ] && installPackages "$list" "$missing"
    return 0
}

# A fresh container has none at all.
hasPackageLists() { compgen -G '/var/lib/apt/lists/*Packages*' >/dev/null; }

# withoutGone NAMES: one a line, without OSMesa where apt has it no more. Mesa has none from 25.1 on, and rungs then use EGL.
withoutGone() {
    if grep -qx libosmesa6 <<<"$1" && ! grep -q 'Candidate: [^(]' <<<"$(LC_ALL=C apt-cache policy libosmesa6)"; then
        grep -vx libosmesa6 <<<"$1" || true
    else
        echo "$1"
    fi
}

installPackages() {
    local list=$1 missing=$2 as_root=() log reason=
    if [ "$(id -u)" != 0 ]; then
        # One line, so that it can be copied from it.
        [ -n "$(type -P sudo)" ] || fail "packages are missing, and only root can install them (there is no sudo)." \
            "As root, run: apt-get install --no-install-recommends $(paste -sd ' ' <<<"$missing")"
        as_root=(sudo)
    fi
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get)
    local update=("${apt[@]}" -o APT::Update::Error-Mode=any update)
    log=$(mktemp)
    if ! hasPackageLists; then
        "${update[@]}" 2>&1 | tee -a "$log" >&2 || true
        if hasPackageLists; then missing=$(withoutGone "$missing"); fi
    fi
    missing=$(paste -sd ' ' <<<"$missing")
    say "These packages are missing and will be installed with apt-get:"
    while read -r name purpose; do
        if [[ -n $name && " $missing " = *" $name "* ]]; then say "  $(printf '%-22s' "$name") $purpose"; fi
    done <<<"$list"
    # shellcheck disable=SC2206
    local install=("${apt[@]}" install -y --no-install-recommends $missing)
    # Old package lists may name versions that are gone.
    "${install[@]}" 2>&1 | tee -a "$log" >&2 ||
        { { "${update[@]}" || true; } && "${install[@]}"; } 2>&1 | tee -a "$log" >&2 || reason="what apt-get said stands above"
    if [ -n "$reason" ] && grep -qE 'Temporary failure resolving|Could not (resolve|connect)|Cannot initiate the connection' "$log"; then
        reason="the package servers cannot be reached from here; connect to the network and try again"
    fi
    rm -f "$log"
    [ -z "$reason" ] || fail "these packages could not be installed: $missing: $reason"
}

# configure PRESET TESTS: configures build/PRESET where that was never done, with the tests where TESTS is ON. A tree
# that lacks them gets them when they are first asked for, and keeps them: it serves whoever needs none as well.
configure() {
    local preset=$1 tests=$2 options log had=
    if [ -e "$build_dir/build.ninja" ]; then
        had=$(sed -n 's/^GLLADDER_TESTS:[A-Z]*=//p' "$build_dir/CMakeCache.txt")
        if [ "$tests" = OFF ] || [ "$had" = ON ]; then return; fi
    fi
    mkdir -p "$build_dir" 2>/dev/null && [ -w "$build_dir" ] ||
        fail "$build_dir cannot be written; copy the project to a folder of your own and run it there"
    options=("-DGLLADDER_TESTS=$tests")
    # Continuous integration also refuses warnings; a newer compiler's must not stop anybody else.
    if [ -n "${CI:-}" ]; then options+=(-DGLLADDER_WERROR=ON); fi
    say "Configuring build/$preset"
    log=$(cd "$root" && cmake --preset "$preset" "${options[@]}" 2>&1) || {
        say "$log"
        # What a rung needs is there all the same, and the next tutorials/run must not stumble over the tests.
        if [ -n "$had" ]; then (cd "$root" && cmake --preset "$preset" "-DGLLADDER_TESTS=$had") >/dev/null 2>&1 || true; fi
        fail "configuring build/$preset failed; the reason stands above"
    }
}

# buildTargets PRESET TESTS TARGET...: configures as above, then brings targets up to date. Says nothing when there is
# nothing to do.
buildTargets() {
    local preset=$1 tests=$2
    shift 2
    configure "$preset" "$tests"
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

# findRung WORD: sets $rung to the only one that WORD fits: its whole name, its number (05, 5), its words (hdr_bloom), or
# any part of its name. The first of these that fits any decides.
findRung() {
    local word=${1%/} number=none quoted pattern name fits
    word=${word##*/} # tutorials/05_hdr_bloom/, as a shell completes it
    if [[ $word =~ ^[0-9]{1,2}$ ]]; then number=$(printf '%02d' "$((10#$word))"); fi
    quoted=$(printf '%q' "$word")
    for pattern in "$quoted" "${number}_*" "[0-9][0-9]_$quoted" "*$quoted*"; do
        fits=()
        for name in "$root"/tutorials/[0-9][0-9]_*/main.cpp; do
            name=$(basename "$(dirname "$name")")
            # shellcheck disable=SC2053
            if [[ $name = $pattern ]]; then fits+=("$name"); fi
        done
        if [ ${#fits[@]} -gt 0 ]; then break; fi
    done
    case ${#fits[@]} in
    1) rung=${fits[0]} ;;
    0)
        say "$me: error: there is no rung \"$1\"; the rungs are"
        rungSummaries >&2
        exit 2
        ;;
    *)
        say "$me: error: \"$1\" fits several rungs; write more of the name"
        rungSummaries | grep -E "^  ($(IFS='|' && echo "${fits[*]}")) " >&2
        exit 2
        ;;
    esac
}
