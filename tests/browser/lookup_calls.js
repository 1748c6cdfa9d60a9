'use strict';
// The functions that `skybake info --lookup` prints, what they are to be called with, and between which bounds their
// results must lie, as printed_lookup_tests notes them; and what shaders of all languages need to call them.
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

// --- Calls --------------------------------------------------------------------------------------

// Returns for each function {file, function, textures, types, channels, calls}.
function noted_functions(printed_tests, work) {
    execFileSync(printed_tests, ['--gtest_brief=1'], {env: {...process.env, SKYBAKE_CALLS: work}});
    const functions = new Map();
    for (const call of JSON.parse(fs.readFileSync(path.join(work, 'calls.json'), 'utf8'))) {
        const key = `${call.file} ${call.function}`;
        const numbers = call.arguments.filter((one) => !one.texture);
        if (!functions.has(key)) {
            functions.set(key, {...call, key, calls: [],
                textures: call.arguments.filter((one) => one.texture), types: numbers.map((one) => one.type)});
        }
        functions.get(key).calls.push({low: call.low, high: call.high,
            given: numbers.flatMap(({value}) => [0, 1, 2, 3].map((i) => value[i] ?? 0))});
    }
    return [...functions.values()];
}

// The functions whose results are not all within their bounds, with the farthest of each.
function misses(functions, results) {
    return functions.flatMap((one, k) => {
        let count = 0;
        let farthest = '';
        one.calls.forEach(({low, high}, i) => {
            const found = results[k].slice(4 * i, 4 * i + low.length);
            if (found.every((value, c) => low[c] <= value && value <= high[c])) return;
            ++count;
            farthest ||= `call ${i}: ${found} is not from ${low} to ${high}`;
        });
        return count > 0 ? [`${one.key}: ${count} of ${one.calls.length}, ${farthest}`] : [];
    });
}

// --- Shaders ------------------------------------------------------------------------------------

// The parameters of a function as it is printed, samplers among them.
function signature_of(code, name) {
    const list = new RegExp(`\\b${name}\\(([^)]*)\\)[^;{]*\\{`).exec(code)[1];
    return list.split(',').map((parameter) => parameter.trim().replace(/\s+/g, ' '));
}

// The call of a function: textures t0, t1 ..., their samplers, and numbers by `number(k)`.
function call_of(one, signature, number) {
    let textures = 0, numbers = 0;
    const list = signature.map((parameter) => {
        if (/SamplerState|: sampler$/.test(parameter)) return `t${textures - 1}_sampler`;
        return /[Tt]exture|sampler[23]D/.test(parameter) ? `t${textures++}` : number(numbers++);
    });
    return `${one.function}(${list.join(', ')})`;
}
const swizzles = {float: 'x', int: 'x', bool: 'x', vec2: 'xy', vec3: 'xyz', vec4: 'xyzw'};
const casts = {int: (x) => `int(${x})`, bool: (x) => `(${x} > 0.5)`};
const typed = (type, texel) => (casts[type] ?? ((x) => x))(`${texel}.${swizzles[type]}`);
// The result as four numbers.
const widened = (value, channels, vec4) =>
    `${vec4}(${[value, ...['0.0', '0.0', '1.0'].slice(channels - 1)].join(', ')})`;

// Returns for each texture whether it is '2D', '3D' or '2DArray'.
function texture_kinds(signature) {
    return signature.filter((one) => /[Tt]exture|sampler[23]D/.test(one)).map(
        (one) => (/2DArray|2d_array/.test(one) ? '2DArray' : /2D|2d/.test(one) ? '2D' : '3D'));
}

module.exports = {call_of, misses, noted_functions, signature_of, texture_kinds, typed, widened};
