'use strict';
// Tests functions of `skybake info --lookup --language godot`, compiled and run by Godot 4.6, whose program for the web
// runs in Chromium without a GPU, and held to the probes of the baked files; and to the same files the wrong way round,
// which must not pass.
//   node godot_lookups.js PROGRAM FOLDER PRINTED_LOOKUP_TESTS PRINTED_FOLDER
const {answers_of_godot, floats_of, write_byte} = require('./godot_project.js');
const {call_of, misses, noted_functions, signature_of, texture_kinds, typed, widened} = require('./lookup_calls.js');
const fs = require('node:fs');
const path = require('node:path');

const [, , , folder, printed_tests, printed_folder] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'godot-lookups-'));

// A shader whose pixel (4 c + b, i) is byte b of channel c of call i.
function shader_of(one, code) {
    const signature = signature_of(code, one.function);
    const kinds = texture_kinds(signature);
    const call = call_of(one, signature, (k) => typed(one.types[k], `texelFetch(given, ivec2(${k}, at.y), 0)`));
    const wraps = (i) => one.textures[i].repeats.some(Boolean) ? 'repeat_enable' : 'repeat_disable';
    return {kinds, text: `shader_type canvas_item;
render_mode unshaded, blend_disabled;
${kinds.map((kind, i) => `uniform sampler${kind} t${i} : filter_linear, ${wraps(i)};`).join('\n')}
uniform sampler2D given : filter_nearest;
${code}
void fragment() {
    ivec2 at = ivec2(FRAGCOORD.xy);
    vec4 found = ${widened(call, one.channels, 'vec4')};
    ${write_byte('at.x / 4', 'at.x % 4')}
}
`};
}

async function main() {
    // Godot's samplers repeat along all axes or along none.
    const functions = noted_functions(printed_tests, work).filter(({textures}) =>
        textures.every(({repeats}) => repeats.every((one) => one === repeats[0])));
    const files = {};
    const asked = functions.map((one) => {
        const {kinds, text} = shader_of(one, fs.readFileSync(path.join(printed_folder, 'godot', `${one.file}.godot`), 'utf8'));
        for (const {texture} of one.textures) files[`${texture}.f32`] = fs.readFileSync(path.join(work, `${texture}.f32`));
        return {shader: text, rows: one.calls.length, columns: Math.max(one.types.length, 1),
                given: one.calls.flatMap(({given}) => given),
                textures: one.textures.map(({texture, size}, i) => ({file: `${texture}.f32`, size, kind: kinds[i]}))};
    });
    const {answers, complaints} = await answers_of_godot(work, folder, 'godot_lookups.gd', asked, files);
    const wrong = misses(functions, answers.map(({found}) => floats_of(found)));
    const caught = misses(functions, answers.map(({reversed}) => floats_of(reversed)));
    const passed = functions.filter(({key, textures}) => textures.length > 0 && !caught.some((line) => line.startsWith(`${key}:`)))
        .map(({key}) => `${key} passes with texels in the opposite order`);
    const faults = [...wrong, ...passed, ...complaints];
    const calls = functions.reduce((sum, one) => sum + one.calls.length, 0);
    console.log(faults.length > 0 ? faults.join('\n') : `${functions.length} functions, ${calls} calls in Godot`);
    fs.rmSync(work, {recursive: true, force: true});
    process.exit(faults.length > 0 || functions.length < 50 ? 1 : 0);
}

main();
