#!/bin/sh
# command.sh BUILD - the command's contract, as a user meets it: exit statuses, messages, files whole or not at all. One line a
# test: "ok ..." or "not ok ...".
build=$1
gnomon=$build/gnomon
scenes=build/scenes
tmp=$build/command
. tests/tools/checks.sh

has() { grep -q "$2" "$1"; }
is_png() { [ "$(head -c 4 "$1" | od -An -tx1 | tr -d ' ')" = 89504e47 ]; }
numbers() { sed -n 's/.*"\('"$2"'\)":[^0-9]*\([0-9.]*\).*/\2/p' "$1" | head -n 1; }

ok "--version" sh -c "$gnomon --version | grep -qE '^gnomon [0-9]+\.[0-9]+\.[0-9]+$'"
for command in render view probe methods measure calibrate select; do
    ok "help $command" sh -c "$gnomon help $command | grep -q 'usage: gnomon $command'"
    ok "$command --help" sh -c "[ \"\$($gnomon $command --help)\" = \"\$($gnomon help $command)\" ]"
done
ok "help lists the commands" sh -c "$gnomon help | grep -q '  probe'"
ok "methods lists zfail, zpass and stencil" sh -c "$gnomon methods | grep -q '^zfail  *exact' && $gnomon methods | grep -q '^zpass  *inexact' && $gnomon methods | grep -q '^stencil  *exact'"
ok "probe names driver and methods" sh -c "$gnomon probe --platform egl | grep -q 'zfail  *possible'"
ok "probe --json is JSON" sh -c "$gnomon probe --json | python3 -c 'import json, sys; assert len(json.load(sys.stdin)) == 6'"
ok "probe --save keeps what is proven" sh -c "$gnomon probe --platform egl --save $tmp/saved > /dev/null && grep -qx 'two-sided-stencil: proven' $tmp/saved"
ok "and nothing where there is no context" sh -c "! $gnomon probe --platform angle --save $tmp/unsaved > /dev/null 2> $tmp/err && grep -q 'no context' $tmp/err && [ ! -e $tmp/unsaved ]"
ok "probe knows methods without a stencil" sh -c "[ \$($gnomon probe --platform egl --hide stencil | grep -cE '^  (count|signed|alpha|screen)  *possible; in ') = 4 ]"
ok "probe says what is hidden" sh -c "$gnomon probe --platform egl --hide w0 | grep -qE '^  w0 +yes +no +yes'"
ok "GNOMON_HIDE hides too" sh -c "GNOMON_HIDE=stencil $gnomon probe --platform egl | grep -q 'zfail .*needs stencil, which is hidden'"
ok "probe says how a method works" sh -c "$gnomon probe --platform egl --hide stencil-wrap | grep -q 'zfail  *possible; counts from -128 to 127'"

refuses 2 "a command is missing"
refuses 2 "(draw)" draw
refuses 2 "takes one scene (0 given)" render
refuses 2 "nothing to do" render $scenes/cube_point.gltf
refuses 2 "(--colour)" render $scenes/cube_point.gltf -o "$tmp/x.png" --colour
refuses 2 "(640)" render $scenes/cube_point.gltf -o "$tmp/x.png" --size 640
refuses 2 "(0x480)" render $scenes/cube_point.gltf -o "$tmp/x.png" --size 0x480
refuses 2 "(0)" render $scenes/cube_point.gltf -o "$tmp/x.png" --frames 0
refuses 2 "(many)" render $scenes/cube_point.gltf -o "$tmp/x.png" --frames many
refuses 2 "(magic)" render $scenes/cube_point.gltf -o "$tmp/x.png" --method magic
refuses 2 "(x11)" render $scenes/cube_point.gltf -o "$tmp/x.png" --platform x11
refuses 2 "(dreams)" render $scenes/cube_point.gltf -o "$tmp/x.png" --show dreams
refuses 2 "(none,w0)" render $scenes/cube_point.gltf -o "$tmp/x.png" --hide none,w0
refuses 2 "(w0s)" probe --hide alpha,w0s
export GNOMON_HIDE=bogus
refuses 2 "GNOMON_HIDE: no capability" probe
refuses 2 "GNOMON_HIDE: no capability" render $scenes/cube_point.gltf -o "$tmp/x.png"
unset GNOMON_HIDE
refuses 2 "(auto/one-sided)" render $scenes/cube_point.gltf -o "$tmp/x.png" --method auto/one-sided
refuses 3 "method stencil needs stencil, which is hidden" render $scenes/cube_point.gltf -o "$tmp/x.png" --hide stencil --method stencil
refuses 3 "none without a stencil is possible" render $scenes/cube_point.gltf -o "$tmp/x.png" --hide stencil,fbo-rgba8,fbo-rgba4,fbo-rgb5a1,fbo-rgb565,blend-subtract,blend-rounding
refuses 2 "(dark)" render $scenes/cube_point.gltf -o "$tmp/x.png" --shade dark
refuses 2 "(3)" render $scenes/cube_point.gltf -o "$tmp/x.png" --scale 3
refuses 2 "(cubic)" render $scenes/cube_point.gltf -o "$tmp/x.png" --upsample cubic
refuses 3 "screen has no room for depth" render $scenes/cube_point.gltf -o "$tmp/x.png" --method screen --scale 2 --upsample depth
refuses 3 "needs packed-depth-stencil" render $scenes/cube_point.gltf -o "$tmp/x.png" --method stencil --scale 4 --hide packed-depth-stencil
refuses 2 "(8,8,8)" render $scenes/cube_point.gltf -o "$tmp/x.png" --bits 8,8,8
refuses 2 "a value is missing" render $scenes/cube_point.gltf -o
refuses 1 "none.gltf" render "$tmp/none.gltf" -o "$tmp/x.png"
refuses 1 "cannot be written" render $scenes/cube_point.gltf --size 16x16 -o "$tmp/no/such/x.png"
export __EGL_VENDOR_LIBRARY_FILENAMES="$tmp/none.json" # an EGL without any driver
refuses 3 "no context of 800x600: egl: surfaceless display: " render $scenes/cube_point.gltf -o "$tmp/x.png" --platform egl
unset __EGL_VENDOR_LIBRARY_FILENAMES
printf '{"asset": {"version": "2.0"}, "extensionsRequired": ["EXT_nonsense"]}' > "$tmp/required.gltf"
refuses 1 "EXT_nonsense" render "$tmp/required.gltf" -o "$tmp/x.png"
head -c 700 $scenes/cube_point.gltf > "$tmp/cut.gltf"
refuses 1 "cut.gltf" render "$tmp/cut.gltf" -o "$tmp/x.png"
ok "a refused run leaves nothing behind" sh -c "! ls $tmp | grep -E 'x\.png|part'"

ok "a frame" "$gnomon" render $scenes/cube_point.gltf -o "$tmp/a.png" --size 160x120
ok "is a PNG" is_png "$tmp/a.png"
ok "again" "$gnomon" render --size=160x120 -o "$tmp/b.png" -- $scenes/cube_point.gltf
ok "two runs give identical bytes" cmp "$tmp/a.png" "$tmp/b.png"
for platform in egl osmesa; do
    ok "masks by $platform" "$gnomon" render $scenes/colours.gltf --mask-dir "$tmp/$platform" --size 160x120 --platform $platform
done
ok "four masks" sh -c "[ \$(ls $tmp/egl | wc -l) = 4 ]"
ok "egl and osmesa give identical masks" diff -r "$tmp/egl" "$tmp/osmesa"
ok "a mask has grey and alpha" sh -c "[ \$(od -An -tu1 -j 25 -N 1 $tmp/egl/light0.png) = 4 ]"
for show in volumes silhouette cases mask; do
    ok "--show $show" "$gnomon" render $scenes/cube_point.gltf -o "$tmp/$show.png" --size 160x120 --show $show
    ok "--show $show changes the picture" sh -c "! cmp -s $tmp/$show.png $tmp/a.png"
done

ok "an animation" "$gnomon" render $scenes/animated.gltf -o "$tmp/moved.png" --frames 30 --size 160x120
ok "its first frame" "$gnomon" render $scenes/animated.gltf -o "$tmp/still.png" --size 160x120
ok "the scene has moved" sh -c "! cmp -s $tmp/moved.png $tmp/still.png"

ok "a report and a plan" "$gnomon" render $scenes/colours.gltf --frames 20 --spin 1 --report "$tmp/r.json" --plan "$tmp/p.json" --size 160x120
ok "both are JSON" python3 -c "import json; json.load(open('$tmp/r.json')); json.load(open('$tmp/p.json'))"
for key in driver renderer target size frames lights method scale reason casters case1 case2 case3 counts draws vertices indices \
    bytes_sent state_changes allocations fragments_rasterised fragments_passed ms frame same_passes_without_volumes \
    one_pass_without_shadows median p5 p95; do
    has "$tmp/r.json" "\"$key\"" || { echo "not ok the report has no $key"; failed=1; }
done
ok "no allocation after the first frame" [ "$(numbers "$tmp/r.json" allocations)" = 0 ]
ok "fragments are counted" [ "$(numbers "$tmp/r.json" fragments_rasterised)" -gt 1000 ]
ok "fewer pass than are rasterised" [ "$(numbers "$tmp/r.json" fragments_passed)" -lt "$(numbers "$tmp/r.json" fragments_rasterised)" ]

ok "masks by z-fail" "$gnomon" render $scenes/colours.gltf --mask-dir "$tmp/zfail" --size 160x120 --platform egl --method zfail
for hide in two-sided-stencil stencil-wrap two-sided-stencil,stencil-wrap w0; do
    ok "masks without $hide" "$gnomon" render $scenes/colours.gltf --mask-dir "$tmp/hidden" --size 160x120 --platform egl --hide $hide --method zfail
    ok "are the same" diff -r "$tmp/zfail" "$tmp/hidden"
done
ok "one-sided by name" "$gnomon" render $scenes/colours.gltf --mask-dir "$tmp/hidden" --size 160x120 --platform egl --method zfail/one-sided --report "$tmp/o.json"
ok "gives the same" diff -r "$tmp/zfail" "$tmp/hidden"
ok "and is reported" has "$tmp/o.json" 'zfail/one-sided'
ok "--explain says why" sh -c "$gnomon render $scenes/cube_point.gltf --size 16x16 --explain --hide two-sided-stencil | grep -q '^light 0: stencil/one-sided: exact for any view; one side at a time, since two-sided-stencil is hidden; '"

ok "and each caster's case" sh -c "$gnomon render $scenes/near_cuts_volume.gltf --size 64x48 --explain > $tmp/cases.txt && grep -q 'case 1, by z-pass.*; sides' $tmp/cases.txt && grep -q 'case 3, by z-fail.*light cap' $tmp/cases.txt"
says() { # scene, words that --explain must say, further options
    what=$1 words=$2
    shift 2
    ok "--explain of $what $*: $words" sh -c "$gnomon render $scenes/$what.gltf --size 64x48 --explain $* | grep -q '$words'"
}
says hall 'scissor .* of 64x48 pixels; 7 casters, 24 left out'
says hall 'left out: it lies beyond the light.s reach'
says torches 'left out: it is exempt'
says dim_lights 'light 4: .*left out: it matters less than was asked for: at most 0.00' --importance 0.1
says stairs 'more layers than 8 bits count: .* batches of up to 12[0-7] layers, folded into a flag'
says near_cuts_volume 'case 1, by z-pass.*; sides'
says cube_point 'light 0: .*of coincident surfaces only the first is lit' --blend-once
ok "the plan has it all" sh -c "$gnomon render $scenes/torches.gltf --size 64x48 --plan $tmp/t.json && python3 -c '
import json
p = json.load(open(\"$tmp/t.json\"))
l = p[\"lights\"][0]
assert l[\"reach\"] < 3.1 and l[\"scissor\"][2] <= 64 and l[\"layers\"] > 0 and l[\"stencil\"][\"bits\"] + l[\"stencil\"][\"patch_bits\"] == 8
assert [o[\"skip\"] for o in l[\"objects\"]].count(\"exempt\") == 1 and p[\"warnings\"] == []'"
ok "a warning before the frame" sh -c "$gnomon render $scenes/near_tiny_wide.gltf --size 64x48 -o $tmp/w.png 2>&1 | grep -q 'four steps of 24 bits of depth are larger than half a pixel'"
ok "probe says how many layers" sh -c "$gnomon probe --platform egl | grep -q 'stencil  *possible; 255 layers at once, more in batches'"
ok "soft lights" "$gnomon" render $scenes/cube_point.gltf -o "$tmp/soft.png" --size 160x120 --soft 16:0.3 --report "$tmp/s.json"
ok "are many" sh -c "[ \$(grep -c '\"method\"' $tmp/s.json) = 16 ]"
ok "and change the picture" sh -c "! cmp -s $tmp/soft.png $tmp/a.png"
ok "one soft light is a hard one" "$gnomon" render $scenes/cube_point.gltf -o "$tmp/hard.png" --size 160x120 --soft 1:0.3
ok "to the last byte" cmp "$tmp/hard.png" "$tmp/a.png"
refuses 2 "(16)" render $scenes/cube_point.gltf -o "$tmp/x.png" --soft 16
refuses 2 "(0:1)" render $scenes/cube_point.gltf -o "$tmp/x.png" --soft 0:1
refuses 2 "(4:-1)" render $scenes/cube_point.gltf -o "$tmp/x.png" --soft 4:-1
refuses 2 "a mask is of one light" render $scenes/cube_point.gltf --mask-dir "$tmp/x" --soft 4:1
for m in count signed alpha screen; do
    ok "$m draws a mask" sh -c "$gnomon render $scenes/cube_point.gltf --size 160x120 --method $m --mask-dir $tmp/$m-masks && [ -s $tmp/$m-masks/light0.png ]"
done
ok "without a stencil it is counted in an image" sh -c "$gnomon render $scenes/cube_point.gltf --size 160x120 --hide stencil --explain | grep -q 'count: the best that is possible here: stencil needs stencil, which is hidden.*counted in an image'"
ok "a target of 565 without stencil and alpha" sh -c "$gnomon render $scenes/cube_point.gltf --size 160x120 --bits 5,6,5,0,16,0 --report $tmp/565.json -o $tmp/565.png 2> /dev/null && grep -q '\"alpha\":[[:space:]]*0' $tmp/565.json && grep -q '\"mask\":[[:space:]]*\"texture\"' $tmp/565.json"
ok "masks at a quarter, by depth" sh -c "$gnomon render $scenes/cube_point.gltf --size 161x121 --scale 4 --upsample depth --report $tmp/small.json -o $tmp/small.png && grep -q '\"scale\":[[:space:]]*4' $tmp/small.json"
ok "the report has the traffic that is expected" grep -q traffic_bytes_estimated "$tmp/565.json"
refuses 2 "(-1)" render $scenes/cube_point.gltf -o "$tmp/x.png" --importance -1
ok "welded edges say what may be off" sh -c "$gnomon render $scenes/pile_of_8.gltf --size 64x48 --weld-angle 10 --explain | grep -q 'may be off by up to 0'"
ok "proxies too" sh -c "$gnomon render $scenes/pile_of_8.gltf --size 64x48 --proxy 500 --explain | grep -q 'may be off by up to 0'"
ok "a proxy has fewer indices" sh -c "$gnomon render $scenes/pile_of_8.gltf --size 64x48 --proxy 500 --report $tmp/proxy.json -o $tmp/proxy.png && [ \$(sed -n 's/.*\"indices\": *\([0-9]*\).*/\1/p' $tmp/proxy.json | head -1) -lt \$(sed -n 's/.*\"indices\": *\([0-9]*\).*/\1/p' $tmp/lag.json | head -1) ]"
refuses 2 "(3)" render $scenes/cube_point.gltf -o "$tmp/x.png" --proxy 3
refuses 2 "(60)" render $scenes/cube_point.gltf -o "$tmp/x.png" --weld-angle 60
refuses 2 "(0)" render $scenes/cube_point.gltf -o "$tmp/x.png" --update-every 0
refuses 2 "(-1)" render $scenes/cube_point.gltf -o "$tmp/x.png" --update-distance -1
ok "what does not move" "$gnomon" render $scenes/pile_of_8.gltf --frames 6 --size 160x120 --report "$tmp/still.json" -o "$tmp/still.png" --plan "$tmp/still-plan.json"
ok "is not found anew" grep -q '"streams_built": 0,' "$tmp/still-plan.json"
ok "sends no index" grep -q '"indices": 0, "cached_indices": [1-9]' "$tmp/still-plan.json"
ok "and looks" "$gnomon" render $scenes/pile_of_8.gltf --size 160x120 -o "$tmp/first.png"
ok "the same" cmp "$tmp/still.png" "$tmp/first.png"
ok "shadows that lag" sh -c "$gnomon render $scenes/pile_of_8.gltf --frames 7 --spin 1 --update-every 4 --size 64x48 --explain --report $tmp/lag.json | grep -q 'before the light moved by up to 0.2'"
ok "no more than is allowed" sh -c "$gnomon render $scenes/pile_of_8.gltf --frames 7 --spin 1 --update-distance 0.09 --size 64x48 --explain --report $tmp/lag.json | grep -q 'before the light moved by up to 0.0'"
printf '{"asset": {"version": "2.0"}}' > "$tmp/empty.gltf"
ok "an empty scene is drawn" "$gnomon" render "$tmp/empty.gltf" -o "$tmp/empty.png" --size 16x16
ok "and says that it placed a camera and a light" sh -c "[ \$($gnomon render $tmp/empty.gltf -o $tmp/empty.png --size 16x16 2>&1 | grep -c placed) = 2 ]"
rm -rf "$tmp"
exit $failed
