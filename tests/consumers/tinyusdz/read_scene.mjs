// Holds the scene tower.usda of a folder to the folder's manifest, as TinyUSDZ understands it: it parses the scene into
// its own layer, and prints that layer.
//   node read_scene.mjs FOLDER
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

// The package is built for browsers; all that it needs of one is its name.
globalThis.window = globalThis;
process.type = 'renderer';
const {default: tinyusdz} = await import('tinyusdz/tinyusdz.js');
const wasmBinary = fs.readFileSync(new URL('node_modules/tinyusdz/tinyusdz.wasm', import.meta.url));
const module = await tinyusdz({wasmBinary, printErr: () => {}, print: () => {}});

// The layer as TinyUSDZ prints it. Throws where it does not read the text.
function layerOf(text) {
    const reader = new module.TinyUSDZLoaderNative();
    const isRead = reader.loadAsLayerFromBinary(new TextEncoder().encode(text), 'scene.usda');
    assert.ok(isRead && reader.ok(), reader.error());
    return reader.layerToString();
}

function inLayer(layer, pattern) {
    const found = pattern.exec(layer);
    assert.ok(found, `there is no ${pattern}`);
    return found[1];
}

function check(text, manifest) {
    const layer = layerOf(text);
    const frames = manifest.assets.filter(({name}) => /^tower_\d+$/.test(name));
    const head = layer.slice(0, layer.indexOf('def Volume "tower"'));
    assert.ok(head.length < layer.length, 'there is no Volume');
    for (const [key, value] of Object.entries({startTimeCode: 1, endTimeCode: frames.length, timeCodesPerSecond: 12,
        framesPerSecond: 12, metersPerUnit: 1, upAxis: '"Z"', defaultPrim: '"tower"'})) {
        assert.equal(inLayer(head, new RegExp(`\\b${key} = (.*)`)), String(value), key);
    }
    assert.equal(inLayer(layer, /rel field:density = (.*)/), '</tower/density>');
    const field = layer.slice(layer.indexOf('def OpenVDBAsset "density"'));
    assert.equal(inLayer(field, /token fieldName = (.*)/), '"density"');
    assert.equal(inLayer(field, /asset filePath = @\.\/(.*)@/), frames[0].files.find(({format}) => format === 'vdb').path);
    const samples = inLayer(field, /asset filePath\.timeSamples = \{([^}]*)\}/);
    const found = Array.from(samples.matchAll(/([\d.]+): @\.\/(.*?)@/g), ([, time, file]) => [Number(time), file]);
    assert.deepEqual(found, frames.map(({name, files}, i) => {
        assert.equal(name, `tower_${String(i + 1).padStart(4, '0')}`);
        return [i + 1, files.find(({format}) => format === 'vdb').path];
    }));
}

const folder = process.argv[2];
const manifest = JSON.parse(fs.readFileSync(path.join(folder, 'manifest.json'), 'utf8'));
const text = fs.readFileSync(path.join(folder, 'tower.usda'), 'utf8');
check(text, manifest);
for (const {files} of manifest.assets) {
    for (const file of files) assert.ok(fs.existsSync(path.join(folder, file.path)), file.path);
}

const spoilt = {
    'a name without its end': text.replace('tower_0003.vdb@', 'tower_0003.vdb'),
    'samples without their end': text.replace('        }\n', ''),
    'a number for a file': text.replace('@./tower_0002.vdb@,', '2,'),
    'a colon less': text.replace('4: @', '4 @'),
    'files exchanged': text.replace('2: @./tower_0002.vdb@', '2: @./tower_0003.vdb@').replace('3: @./tower_0003.vdb@', '3: @./tower_0002.vdb@'),
    'time codes from 0': text.replace(/(\d): @/g, (_, n) => `${n - 1}: @`),
    'a frame less': text.replace(/ *6: @.*\n/, ''),
    'another rate': text.replace('timeCodesPerSecond = 12', 'timeCodesPerSecond = 24'),
    'no field': text.replace('</tower/density>', '</tower/other>'),
};
for (const [how, wrong] of Object.entries(spoilt)) {
    assert.notEqual(wrong, text, how);
    assert.throws(() => check(wrong, manifest), undefined, `a scene with ${how} passes`);
}
console.log(`TinyUSDZ reads ${manifest.assets.filter(({name}) => /^tower_/.test(name)).length} frames as they are, and ${
    Object.keys(spoilt).length} spoilt scenes were refused`);
