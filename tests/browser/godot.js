'use strict';
// Tests the files of the target godot in Godot 4.6, whose program for the web runs in Chromium without a GPU: shaders
// read the probes' values from the DDS textures, most by the includes and cubes by direction alone, the fog stands where
// the cloud is, cameras see the skies of the environments, and their lamps light white planes. The textures come without an import: no file .import is
// there, and they have the format and the levels of the files.
//   node godot.js PROGRAM FOLDER
const {answers_of_godot, floats_of, write_byte} = require('./godot_project.js');
const {cube_probes, direction_of} = require('./cube_probes.js');
const {faults_of_lamp, normals_of} = require('./lit_planes.js');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const [, , program, folder] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'godot-'));

// A shader whose pixel 16 i + 4 c + b is byte b of channel c at place i.
const shader_of = (asset, id, head) => `shader_type canvas_item;
render_mode unshaded, blend_disabled;
${head}
uniform vec3 places[${asset.places}];
void fragment() {
    int at = int(FRAGCOORD.x);
    vec4 found = ${id}_at(places[at / 16]${asset.dim === 2 ? '.xy' : ''});
    ${write_byte('at / 4 % 4', 'at % 4')}
}
`;

// The program for the web draws by OpenGL, which has no fog.
const no_fog = /shader type fog not supported in OpenGL renderer|^ *at: shader_set_code/;

// An environment has no include: materials of the sky read it.
const sky_of = (id, height) => `uniform sampler2D ${id} : filter_linear, repeat_enable;
vec4 ${id}_at(vec2 at) { return texture(${id}, vec2(at.x, clamp(at.y, 0.5 / ${height}.0, 1.0 - 0.5 / ${height}.0))); }`;

const cube_sky_of = (id) => `uniform samplerCube ${id} : filter_linear;
vec4 ${id}_at(vec3 at) { return textureLod(${id}, at, 0.0); }`;

const is_cube = (asset) => asset.mapping.name === 'cube';
const probes_of = (asset) => is_cube(asset) ? cube_probes(asset, 1) : asset.probes;

function places_of(asset) {
    if (is_cube(asset)) return probes_of(asset).map(({direction}) => direction);
    const lookups = asset.probes.flatMap((probe) => [probe.uvw ?? probe.uv, ...(probe.blend ? [probe.blend.uvw] : [])]);
    return lookups.map(([u, v, w]) => [u, v, w ?? 0.5]);
}

// Returns the views of cameras: every third probe, and its direction in Godot, ahead being -z. The zenith has no
// azimuth.
function views_of(asset) {
    const probes = probes_of(asset).filter(({at}, i) => i % 3 === 0 && Math.abs(at.elevation_deg) < 89);
    return probes.map((probe) => {
        const [right, up, ahead] = direction_of(probe);
        return {probe, direction: [right, up, -ahead]};
    });
}

// Returns the question to the project about an asset of the manifest.
function question(asset) {
    const named = (end) => asset.files.map((file) => file.path).find((name) => name.endsWith(end));
    const id = asset.name.replaceAll('-', '_');
    const places = places_of(asset);
    const include = named('.gdshaderinc');
    const sky = is_cube(asset) ? cube_sky_of(id) : sky_of(id, asset.size[1]);
    const dim = is_cube(asset) ? 3 : asset.size.length;
    return {
        id, places, file: asset.files[0].path,
        shader: shader_of({places: places.length, dim}, id, include ? `#include "res://${include}"` : sky),
        ...(named('.tscn') && {scene: named('.tscn')}),
        ...(named('.tres') && {environment: named('.tres'), views: views_of(asset).map(({direction}) => direction),
                               normals: normals_of(asset).map(([right, up, ahead]) => [right, up, -ahead])}),
    };
}

function faults_of_probes(asset, bits) {
    const values = floats_of(bits);
    let next = 0;
    const found_there = () => values.slice(4 * next, 4 * ++next);
    return probes_of(asset).flatMap((probe, i) => {
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

// Light as a byte of sRGB.
const encoded = (value) => 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);

// Returns a radiance as a camera shows it, from 0 to 255: the renderer takes the shader's result, which is the curve of
// sRGB, back by a polynomial, and gives it the curve again by a power that is 0 where it is dark.
//
// Source: Godot 4.6, drivers/gles3/shaders/tonemap_inc.glsl.
function shown(value) {
    const given = encoded(value) / 255;
    const linear = given * (given * (given * 0.305306011 + 0.682171111) + 0.012522878);
    return 255 * Math.max(1.055 * linear ** 0.416666667 - 0.055, 0);
}

function faults_of_sky(asset, colors) {
    return views_of(asset).flatMap(({probe}, i) => probe.value.flatMap((value, c) =>
        Math.abs(colors[i][c] - shown(value)) <= 1.5 ? [] :
            [`${asset.name}, view ${i}: ${colors[i]} is not ${probe.value.map(shown)}`]));
}

// Image.Format of Godot, by the type and the number of channels in the file.
const formats = {half: {1: 12, 4: 15}, float: {1: 8, 4: 11}, unorm8: {1: 0, 4: 5}};

function faults_of_texture(asset, answer) {
    const kind = is_cube(asset) ? 'Cubemap' : asset.size.length === 3 ? 'ImageTexture3D' : 'ImageTexture';
    const channels = asset.channels.length === 3 ? 4 : asset.channels.length;
    const wanted = [kind, asset.size.join(), formats[asset.files[0].pixel_type][channels], asset.mips.length > 0];
    const found = [answer.kind, answer.size.join(), answer.format, answer.has_mips];
    return found.join() === wanted.join() ? [] : [`${asset.name} is ${found.join(' ')}, not ${wanted.join(' ')}`];
}

function faults_of(asset, answer) {
    const faults = [...faults_of_texture(asset, answer), ...faults_of_probes(asset, answer.bits)];
    if (asset.kind === 'cloud_volume') faults.push(...faults_of_fog(asset, answer.fog));
    if (asset.kind === 'environment') faults.push(...faults_of_sky(asset, answer.seen), ...faults_of_lamp(asset, answer.lit, encoded, 1.5));
    return faults;
}

async function main() {
    const baked = path.join(work, 'baked');
    execFileSync(program, ['bake', path.join(__dirname, 'targets.toml'), '-o', baked, '-q', '--certify=off',
                           '--set', 'target="godot"', '--set', 'bake.cube.mips=1', '--set', 'bake.cube.level_content="mean"'],
                 {stdio: 'inherit'});
    const manifest = JSON.parse(fs.readFileSync(path.join(baked, 'manifest.json'), 'utf8'));
    const files = {};
    for (const asset of manifest.assets) {
        for (const file of asset.files) files[file.path] = fs.readFileSync(path.join(baked, file.path));
    }
    const {answers, complaints} =
        await answers_of_godot(work, folder, 'godot_main.gd', manifest.assets.map(question), files);
    const faults = manifest.assets.flatMap((asset, i) => faults_of(asset, answers[i]));
    faults.push(...complaints.filter((text) => !no_fog.test(text)));
    const probes = manifest.assets.reduce((sum, asset) => sum + asset.probes.length, 0);
    console.log(faults.length > 0 ? faults.join('\n') : `${answers.length} assets, ${probes} probes in Godot`);
    fs.rmSync(work, {recursive: true, force: true});
    process.exit(faults.length > 0 || probes < 150 ? 1 : 0);
}

main();
