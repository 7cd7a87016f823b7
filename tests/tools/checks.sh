# checks.sh - what the command's tests share. Sourced with $gnomon and $tmp set, of which it makes an empty folder; one line a test:
# "ok ..." or "not ok ...".
failed=0
rm -rf "$tmp"
mkdir -p "$tmp"
python=python3 # Debian's own has what Debian's packages bring
[ -x /usr/bin/python3 ] && python=/usr/bin/python3

ok() { # what, then a command that must succeed
    what=$1
    shift
    if "$@" > "$tmp/out" 2>&1; then echo "ok $what"; else echo "not ok $what"; sed 's/^/    /' "$tmp/out" | head -n 5; failed=1; fi
}
refuses() { # status, words of its one line, the command's arguments
    status=$1 words=$2
    shift 2
    "$gnomon" "$@" > "$tmp/out" 2> "$tmp/err"
    got=$?
    if [ $got = "$status" ] && [ "$(wc -l < "$tmp/err")" = 1 ] && grep -q "^gnomon: .*$words" "$tmp/err" && [ ! -s "$tmp/out" ]; then
        echo "ok refuses: $*"
    else
        echo "not ok refuses: $* (status $got, wanted $status with '$words')"
        sed 's/^/    /' "$tmp/err"
        failed=1
    fi
}
