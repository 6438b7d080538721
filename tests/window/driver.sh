# Functions for using a rung's window as a person does, on an Xvfb display of its own. To be sourced, with the
# arguments PROGRAM OUTPUT_FOLDER.
set -euo pipefail

program=$1
output=$2
rung=$(basename "$program")
assets=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../assets" && pwd)
patience_s=20 # for one step, on a busy machine

files=() # options that give the rung some, by names relative to its folder

work=$(mktemp -d)
window_process=
display_process=
cleanup() {
    local code=$?
    trap - EXIT
    # Sent home first: a program that has lost its display complains.
    if [ -n "$window_process" ]; then kill "$window_process" 2>/dev/null && wait "$window_process" || true; fi
    if [ -n "$display_process" ]; then kill "$display_process" 2>/dev/null && wait "$display_process" || true; fi
    rm -rf "$work"
    exit "$code"
}
trap cleanup EXIT
trap 'exit 1' INT TERM

rm -rf "$output"
mkdir -p "$output"
cd "$work"
mkdir again # for what is rendered once more

fail() {
    echo "FAILED: $*"
    if [ -s errors.txt ]; then sed 's/^/stderr: /' errors.txt; fi
    if [ -n "${window:-}" ]; then import -window root "$output/failed.png" 2>/dev/null && echo "see $output/failed.png"; fi
    exit 1
}
passed() { echo "ok: $*"; }

# until_true COMMAND...: tries until it succeeds; fails where that takes too long or the window's program ends.
until_true() {
    local end=$((SECONDS + patience_s)) tries=0
    until "$@"; do
        if [ -n "$window_process" ] && ! kill -0 "$window_process" 2>/dev/null; then return 1; fi
        if [ $SECONDS -ge $end ]; then return 1; fi
        if [ $((++tries)) -lt 10 ]; then sleep 0.05; else sleep 0.4; fi # looking at a window costs, too
    done
}

# How many pixels differ; "size" where the sizes do.
difference() {
    if [ "$(identify -format '%wx%h' "$1")" != "$(identify -format '%wx%h' "$2")" ]; then
        echo size
        return
    fi
    compare -metric AE "$1" "$2" null: 2>&1 || true
}
same() { [ "$(difference "$1" "$2")" = 0 ]; }

saves() { grep -c '^wrote' log.txt || true; }
more_saves_than() { [ "$(saves)" -gt "$1" ]; }
# Presses P and waits for the file; leaves its name without the ending in $saved.
save() {
    local before
    before=$(saves)
    xdotool key p
    until_true more_saves_than "$before" || fail "P saved no frame; $(tail -1 log.txt)"
    saved=$(sed -n 's/^wrote \(.*\)\.png$/\1/p' log.txt | tail -1)
    [ -s "$saved.png" ] && [ -s "$saved.txt" ] || fail "P said that it wrote $saved.png, and did not"
}
# The last save against what its command line renders when a shell is given it as it stands, which overwrites nothing.
# Where the rung was given a file by a relative name: in another folder.
reproduce() {
    local line place=. before
    line=$(<"$saved.txt")
    if [ ${#files[@]} -gt 0 ]; then place=again; fi
    [ ! -e "$place/${saved}_again.png" ] || fail "$line would overwrite ${saved}_again.png"
    before=$(cksum -- *.png)
    (cd "$place" && sh "$work/$saved.txt") >/dev/null 2>again.txt || fail "the command line $line failed: $(<again.txt)"
    same "$saved.png" "$place/${saved}_again.png" ||
        fail "$1: $(difference "$saved.png" "$place/${saved}_again.png") pixels differ from what $line renders"
    [ "$place" = again ] || mv "${saved}_again.png" again/
    [ "$(cksum -- *.png)" = "$before" ] || fail "$line overwrites a picture"
    passed "$1: $line renders the same picture"
}
frame_number() { sed -n 's/.*--frame \([0-9]*\).*/\1/p' "$saved.txt"; }
has() { grep -qF -- "$1" "$saved.txt"; }
screenshot() { timeout 10 import -window "$window" "$1"; } # which waits for a click where there is no such window
shows() { screenshot shot.png && same shot.png "$1"; }
resized() {
    save
    has "--size $1 "
}
resize() { xdotool windowsize "$window" "${1%x*}" "${1#*x}"; }
find_window() { window=$(xdotool search --onlyvisible --name "^$rung - GL Ladder" 2>/dev/null | head -1) && [ -n "$window" ]; }
is_unmapped() { xwininfo -id "$window" | grep -q IsUnMapped; }
ended() { ! kill -0 "$window_process" 2>/dev/null; }
is_mapped() { xwininfo -id "$window" | grep -q IsViewable; }
focus() { xdotool windowfocus --sync "$window"; }
# open_paused OPTION...: a window of the program, which plays nothing until it is told.
open_paused() {
    echo '{"is_playing": false}' >paused.json
    "$program" --window-state paused.json "$@" >log.txt 2>errors.txt &
    window_process=$!
    until_true find_window || fail "no window opens"
    until_true focus || fail "the window takes no focus"
}

# Without -noreset it forgets the display's scale with the program that set it.
Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp -noreset 3>display.txt 2>xvfb.txt &
display_process=$!
until_true [ -s display.txt ] || fail "Xvfb does not start: $(<xvfb.txt)"
DISPLAY=:$(<display.txt)
export DISPLAY
unset WAYLAND_DISPLAY
# Its own, where a machine has none, as in a container: some libraries complain of that on the program's stderr.
export XDG_RUNTIME_DIR=$work/runtime
export XDG_CONFIG_HOME=$work/config
mkdir -m 700 "$XDG_RUNTIME_DIR"
