'use strict';
// Tests functions of `skybake info --lookup --language`, run by Chromium without a GPU and held to the probes of the
// baked files: GLSL and Godot's language in WebGL 2, HLSL there too (by way of glslang, SPIR-V and
// SPIRV-Cross), WGSL in WebGPU. Metal's language, which nothing here can compile, runs as C++ in tests/lookups.
//   node lookups.js PROGRAM FOLDER LANGUAGE PRINTED_LOOKUP_TESTS PRINTED_FOLDER
// PRINTED_LOOKUP_TESTS notes what to call, with what, and between which bounds the result must lie.
const assert = require('node:assert/strict');
const {execFileSync, spawnSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {browser_with_a_page} = require('./page_of.js');
const {call_of, misses, noted_functions, signature_of, texture_kinds, typed, widened} = require('./lookup_calls.js');

const [, , , folder, language, printed_tests, printed_folder] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'lookups-'));

const is_installed = (program, option) => spawnSync(program, [option]).error === undefined;

// --- Shaders ------------------------------------------------------------------------------------

function glsl_shader(one, code) {
    const signature = signature_of(code, one.function);
    const call = call_of(one, signature, (k) => typed(one.types[k], `texelFetch(given, ivec2(${k}, i), 0)`));
    const kinds = texture_kinds(signature);
    return {kinds, text: `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler3D;
precision highp sampler2DArray;
${code}
${kinds.map((kind, i) => `uniform sampler${kind} t${i};`).join('\n')}
uniform sampler2D given;
out vec4 found;
void main() {
    int i = int(gl_FragCoord.x);
    found = ${widened(call, one.channels, 'vec4')};
}
`};
}

function hlsl_shader(one, code) {
    const signature = signature_of(code, one.function);
    const call = call_of(one, signature, (k) => typed(one.types[k], `given.Load(int3(${k}, i, 0))`));
    const kinds = texture_kinds(signature);
    const name = path.join(work, one.key.replace(' ', '.'));
    fs.writeFileSync(`${name}.hlsl`, `${code}
${kinds.map((kind, i) => `Texture${kind} t${i} : register(t${i});
SamplerState t${i}_sampler : register(s${i});`).join('\n')}
Texture2D given : register(t8);
float4 main(float4 at : SV_Position) : SV_Target {
    int i = int(at.x);
    return ${widened(call, one.channels, 'float4')};
}
`);
    execFileSync('glslangValidator', ['-D', '-V', '-S', 'frag', '-e', 'main', '-o', `${name}.spv`, `${name}.hlsl`]);
    const text = execFileSync('spirv-cross', ['--es', '--version', '300', `${name}.spv`], {encoding: 'utf8'});
    return {kinds, text: text.replaceAll('mediump', 'highp')};
}

function wgsl_shader(one, code) {
    const signature = signature_of(code, one.function);
    const call = call_of(one, signature, (k) => typed(one.types[k], `given[${one.types.length} * i + ${k}]`)
        .replace(/\bint\(/, 'i32('));
    const kinds = texture_kinds(signature);
    return {kinds, text: `${code}
@group(0) @binding(0) var<storage, read> given: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> found: array<vec4f>;
${kinds.map((kind, i) => `@group(0) @binding(${2 + 2 * i}) var t${i}: texture_${kind.replace('Array', '_array').toLowerCase()}<f32>;
@group(0) @binding(${3 + 2 * i}) var t${i}_sampler: sampler;`).join('\n')}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
    let i = i32(id.x);
    if (i >= ${one.calls.length}) { return; }
    found[i] = ${widened(call, one.channels, 'vec4f')};
}
`};
}

const languages = {
    glsl: {shader: glsl_shader, run: 'run_in_webgl'},
    godot: {shader: glsl_shader, run: 'run_in_webgl'},
    hlsl: {shader: hlsl_shader, run: 'run_in_webgl',
        needs: [['glslangValidator', '--version', 'glslang-tools'], ['spirv-cross', '--help', 'spirv-cross']]},
    wgsl: {shader: wgsl_shader, run: 'run_in_webgpu'},
};

// --- Tests --------------------------------------------------------------------------------------

// Returns the results of each function from the files, and from the same files the wrong way round.
async function results_of(page, {shader, run}, functions) {
    const found = [], reversed = [];
    for (const one of functions) {
        const code = fs.readFileSync(path.join(printed_folder, language, `${one.file}.${language}`), 'utf8');
        const {text, kinds} = shader(one, code);
        const textures = one.textures.map((texture, i) => ({...texture, kind: kinds[i]}));
        const job = {name: one.key, text, textures, rows: one.calls.length, columns: one.types.length,
            given: one.calls.flatMap(({given}) => given)};
        const results = await page.evaluate(([name, job]) => window.results_of(window[name], job), [run, job]);
        found.push(results.found);
        reversed.push(results.reversed);
    }
    return {found, reversed};
}

function skip(reason) {
    console.log(`skipped: ${reason}`);
    process.exit(77);
}

async function main() {
    const rules = languages[language];
    for (const [program, option, package_name] of rules.needs ?? []) {
        if (!is_installed(program, option)) skip(`there is no ${program} (Debian's ${package_name})`);
    }
    const functions = noted_functions(printed_tests, work);
    assert.ok(functions.length >= 59, `${functions.length} functions`);
    const {browser, page} = await browser_with_a_page(work, {page: __dirname, calls: work},
        '<script src="page/lookups_page.js"></script>');
    const {found, reversed} = await results_of(page, rules, functions);
    const wrong = misses(functions, found);
    const calls = functions.reduce((sum, one) => sum + one.calls.length, 0);
    console.log(`${functions.length} functions, ${calls} calls, wrong: ${wrong.length}`);
    wrong.forEach((line) => console.log(`      ${line}`));
    const caught = misses(functions, reversed);
    const passed = functions.filter(({key, textures}) => textures.length > 0 && !caught.some((line) => line.startsWith(`${key}:`)));
    passed.forEach(({key}) => console.log(`      ${key} passes with texels in the opposite order`));
    assert.deepEqual([...wrong, ...passed], []);
    assert.deepEqual(page.complaints, []);
    await browser.close();
    fs.rmSync(work, {recursive: true, force: true});
}

main().catch((error) => {
    console.log(error.stack);
    process.exit(1);
});
