'use strict';
// Compares the picture of an example of examples/runtimes, in Chromium without a GPU, with that of `skybake preview`
// of the same bake from the same camera; it must be another picture if one of the files is upside down. The shaders
// for Vulkan and Direct3D become SPIR-V, and SPIRV-Cross makes WebGL's GLSL of that. The modules for three.js and
// Babylon.js draw with these programs, and Godot's own program for the web draws its project.
//   node runtime_example.js PROGRAM FOLDER EXAMPLES webgl|webgpu|glsl|hlsl|three|babylon|godot
const assert = require('node:assert/strict');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {pathToFileURL} = require('node:url');
const {answers_of_godot} = require('./godot_project.js');
const {browser_with_a_page, on_canvas, site} = require('./page_of.js');

const [, , program, folder, examples, name_of_example] = process.argv;
const work = fs.mkdtempSync(path.join(folder, `${name_of_example}-`));
const is_module = ['three', 'babylon'].includes(name_of_example);
const name_of_folder = is_module ? 'npm' : name_of_example;
const example = path.join(work, name_of_folder);
const is_godot = name_of_example === 'godot';
const has_page = fs.existsSync(path.join(examples, name_of_example, 'index.html'));

// Small pictures have four samples for each pixel in the preview, and so here.
const size = [96, 54];
const common = {heading: 63, fov: 70, sun_azimuth: 175, exposure: 12, size: size.map((edge) => 2 * edge)};
// With root mean squares of differences in bytes of sRGB, a quarter above what is measured. The page's light of
// clouds from sky and ground comes along four lines, where the preview's spreads all around; straight up and down
// alone it is 5 off. The ports of WebGL's shaders have fewer views.
const is_port = name_of_example !== 'webgl';
//
// The preview varies the copies of the tile, and the examples repeat it. So clouds are seen from below the middle of
// the first copy, from where rays and what shades them stay within it. A cloud fills half of the picture.
const below = {...common, position: [2200, 2700, 200], pitch: 68, fov: 36};
const views = {
    clouds: {...below, sun_elevation: 50, bound: 1.25},
    evening: {...below, sun_elevation: 30, bound: 1.15},
    clear_sky: {...common, position: [0, 0, 3000], pitch: 30, sun_elevation: 20, bound: 0.6},
    // The sky opposite the sun below the horizon, whose light depends most on direction.
    dusk: {...common, position: [0, 0, 3000], heading: 355, pitch: 25, sun_elevation: -4, exposure: 1000, bound: 0.6},
    ground: {...common, position: [0, 0, 99000], pitch: -8, fov: 60, sun_elevation: 20, bound: 0.65},
};

// The examples draw no shadows of clouds on the ground, which is plain. So their ground is compared with the
// preview's of clouds without extinction, from so high that a pixel is wider than all patches of the preview's
// ground, and in the rows below the limb of the air; in all other views the rows above the horizon are compared.
const without_extinction = ['--set', 'clouds.cumulus.extinction_scale="0 /km"'];
function compared_rows({pitch, fov}) {
    const edge = Math.tan(0.5 * fov * Math.PI / 180) * size[1] / size[0];
    const row_of = (elevation) => Math.floor(0.5 * size[1] * (1 + Math.tan((pitch - elevation) * Math.PI / 180) / edge));
    return pitch < 0 ? [row_of(-12), size[1]] : [0, Math.min(size[1], row_of(0))];
}

// Draws a view by the program; returns the picture's path below the test's folder.
function preview(name) {
    const {position, heading, pitch, fov, sun_elevation, sun_azimuth, exposure} = views[name];
    const camera = `position=${position.map((m) => `${m}m`).join(',')} heading=${heading}deg pitch=${pitch}deg fov=${fov}deg`;
    const shown = pitch < 0 ? [path.join(work, 'recipe.toml'), ...without_extinction] : [path.join(example, 'baked')];
    execFileSync(program, ['preview', ...shown, '-o', path.join(work, `preview_${name}`), '-q', '--table-sky', '--camera', camera, '--size', size.join('x'), '--exposure', String(Math.log2(exposure)),
        '--sun-elevation', String(sun_elevation), '--sun-azimuth', String(sun_azimuth)]);
    return `preview_${name}/cloud_lit_sun_${String(sun_elevation).replace('-', 'minus_')}.png`;
}

// A copy of the bake in which one file has its rows, or a volume its slices, in the opposite order.
function upside_down(name) {
    const copy = path.join(work, `flipped_${name}`);
    fs.cpSync(path.join(example, 'baked'), copy, {recursive: true});
    const manifest = JSON.parse(fs.readFileSync(path.join(copy, 'manifest.json'), 'utf8'));
    const count = manifest.assets.find((asset) => asset.name === name).size.at(-1);
    const file = path.join(copy, `${name}.${is_godot ? 'dds' : 'bin'}`), bytes = fs.readFileSync(file);
    const head = !is_godot ? 0 : bytes.toString('latin1', 84, 88) === 'DX10' ? 148 : 128;
    const length = (bytes.length - head) / count;
    const rows = Array.from({length: count}, (_, i) => bytes.subarray(head + i * length, head + (i + 1) * length));
    fs.writeFileSync(file, Buffer.concat([bytes.subarray(0, head), ...rows.reverse()]));
    return path.basename(copy);
}

// What a page finds modules by. Babylon.js is a script, whose names a module gives to the one that imports it.
const names_of_babylon = ['Constants', 'Effect', 'MaterialPluginBase', 'Mesh', 'RawTexture', 'RawTexture3D', 'ShaderMaterial', 'Vector3', 'VertexData'];
const module_scripts = `<script type="importmap">${JSON.stringify({imports: {
    three: '/modules/three/build/three.module.js',
    '@babylonjs/core': `data:text/javascript,export const {${names_of_babylon}} = BABYLON;`,
    'skybake/three': '/work/npm/skybake.three.js', 'skybake/babylon': '/work/npm/skybake.babylon.js'}})}</script>
    ${name_of_example === 'babylon' ? '<script src="/modules/babylonjs/babylon.js"></script>' : ''}
    <script src="page/module_page.js"></script>`;

// A view by Godot, as bytes of RGBA.
async function drawn_by_godot(baked, view) {
    const {uniforms_of} = await import(pathToFileURL(path.join(examples, 'view.js')));
    const files = Object.fromEntries(['picture.gdshader', 'picture.tscn'].map((name) => [name, fs.readFileSync(path.join(example, name))]));
    for (const name of fs.readdirSync(path.join(work, baked))) files[`baked/${name}`] = fs.readFileSync(path.join(work, baked, name));
    const asked = {size: view.size, uniforms: Array.from(uniforms_of(view))};
    const {answers, complaints} = await answers_of_godot(work, folder, 'godot_example.gd', asked, files);
    assert.deepEqual(complaints, []);
    return answers;
}

// Draws a view of a bake. `shader` is WebGL's, of an example that has no page of its own. Its rows begin at the top,
// as they do in Vulkan.
const draw = (page, folder, view, shader) => is_godot ? drawn_by_godot(folder, view) : is_module ? page.evaluate(async ([name, url, view]) =>
    window.reduced(await window.draw_by_module[name](url, view), 2), [name_of_example, `work/${folder}`, view]) :
    page.evaluate(async ([url, view, main, shader]) => {
    const {renderer} = await import(main);
    const canvas = document.createElement('canvas');
    (await renderer(canvas, url, shader))(view);
    return window.reduced(shader ? window.upside_down(canvas) : canvas, 2);
}, [`work/${folder}`, view, `./work/${has_page ? name_of_example : 'webgl'}/main.js`, shader]);

// The shader of an example without a page, as GLSL of WebGL 2. SPIRV-Cross names a texture after itself and each of
// its samplers.
function ported_shader() {
    const [file, ...options] = name_of_example === 'glsl' ? ['vulkan.frag'] : ['picture.hlsl', '-D', '-S', 'frag', '-e', 'main'];
    const binary = path.join(work, 'picture.spv');
    execFileSync('glslangValidator', ['-V', ...options, '-o', binary, path.join(example, file)]);
    const text = execFileSync('spirv-cross', ['--es', '--version', '300', binary], {encoding: 'utf8'});
    const lines = text.replaceAll('mediump', 'highp').replace(/SPIRV_Cross_Combined(\w+?_table)\w+/g, '$1').split('\n');
    return lines.filter((line, i) => !line.startsWith('uniform') || lines.indexOf(line) === i).join('\n');
}

// The page that people open shows its first view, as its renderer draws it, and draws again when a slider moves.
const first_view = {...common, position: [0, 0, 200], pitch: 15, sun_elevation: 20};
const page_bound = 5.9;
async function check_page(page, picture) {
    await page.goto(`${site}work/${name_of_example}/index.html`);
    await page.waitForFunction(() => document.querySelectorAll('input').length === 5);
    await page.addScriptTag({path: path.join(__dirname, 'pictures_page.js')});
    const differs = async () => {
        const shot = await page.locator('#picture').screenshot();
        const shown = await page.evaluate(([url, size]) => window.picture(url, ...size),
            [`data:image/png;base64,${shot.toString('base64')}`, size]);
        return rms(shown, picture, [0, size[1]]);
    };
    const error = await differs();
    console.log(`index.html: RMS ${error.toFixed(2)} of 255`);
    assert.ok(error <= page_bound);
    await page.evaluate(() => {
        const slider = document.querySelector('input');
        slider.value = 4;
        slider.dispatchEvent(new Event('input'));
    });
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    assert.ok(await differs() > page_bound);
}

// A wall behind all the air has the colour of the sky, one before it has its own, and one between has some of both.
async function check_walls(page) {
    const view = {...views.clear_sky, exposure: 3, wall: 0x000000};
    const wall = (colour, distance) => page.evaluate(([module, ...rest]) => window.wall_behind_air[module](...rest),
        [name_of_example, `work/${name_of_folder}/baked`, {...view, wall: colour}, distance]);
    const near = await wall(0x808080, 10), far = await wall(0x000000, 4e5), half_way = await wall(0x000000, 1e4);
    console.log('walls behind air:', near, half_way, far);
    for (const {before_wall, linear} of [near, half_way, far]) {
        linear?.forEach((value, c) => assert.ok(Math.abs(value - before_wall[c]) <= 1));
    }
    near.before_wall.forEach((value) => assert.ok(Math.abs(value - 128) <= 1));
    far.before_wall.forEach((value, c) => {
        assert.ok(Math.abs(value - far.sky[c]) <= 2 && value > 20);         // 12 steps in the place of 40
        assert.ok(half_way.before_wall[c] > 4 && half_way.before_wall[c] < value - 4);
    });
}

function rms(a, b, [first, end]) {
    const from = 4 * size[0] * first, values = a.slice(from, 4 * size[0] * end);
    let sum = 0;
    values.forEach((value, i) => { sum += i % 4 < 3 ? (value - b[from + i]) ** 2 : 0; });
    return Math.sqrt(sum / (0.75 * values.length));
}

async function main() {
    fs.cpSync(examples, work, {recursive: true, filter: (one) => path.basename(one) !== 'baked'});
    execFileSync(path.join(work, 'bake.sh'), [name_of_folder, program], {stdio: 'ignore'});
    const shader = has_page || is_module || is_godot ? undefined : ported_shader();
    const {browser, page} = await browser_with_a_page(work, {work, page: __dirname, modules: path.join(folder, 'node_modules')},
        `<script src="page/pictures_page.js"></script>${is_module ? module_scripts : ''}`,
        name_of_example === 'webgpu' ? on_canvas : undefined);
    const pictures = {};
    const wrong = [];
    const measure = async (folder, name, is_right) => {
        const error = rms(await draw(page, folder, views[name], shader), pictures[name], compared_rows(views[name]));
        console.log(`${folder}, ${name}: RMS ${error.toFixed(2)} of 255`);
        if ((error <= views[name].bound) !== is_right) wrong.push(`${folder}, ${name}`);
    };
    for (const name of Object.keys(views).filter((view) => !is_port || view !== 'evening')) {
        pictures[name] = await page.evaluate((url) => window.picture(url), `work/${preview(name)}`);
        await measure(`${name_of_folder}/baked`, name, true);
    }
    for (const name of is_port ? [] : ['transmittance', 'multiple_scattering']) await measure(upside_down(name), 'clear_sky', false);
    for (const name of is_port ? ['cloud'] : ['cloud', 'cells']) await measure(upside_down(name), 'clouds', false);
    assert.deepEqual(wrong, []);
    if (is_module) await check_walls(page);
    if (has_page) await check_page(page, await draw(page, `${name_of_example}/baked`, first_view, shader));
    assert.deepEqual(page.complaints, []);
    await browser.close();
    fs.rmSync(work, {recursive: true, force: true});
}

main().catch((error) => {
    console.log(error.stack);
    process.exit(1);
});
