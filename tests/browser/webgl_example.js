'use strict';
// What examples/runtimes/webgl draws, in Chromium without a GPU, beside what `skybake preview` shows of the same
// bake from the same camera; and that it is another picture if one of the files is upside down.
//   node webgl_example.js PROGRAM FOLDER EXAMPLE
const assert = require('node:assert/strict');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {browser_with_a_page} = require('./page_of.js');

const [, , program, folder, example] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'webgl-'));

// Small pictures have four samples for each pixel in the preview, and so here.
const size = [96, 54];
const common = {heading: 63, fov: 70, sun_azimuth: 105, exposure: 12, size: size.map((edge) => 2 * edge)};
// With root mean squares of differences in bytes of sRGB, a quarter above what is measured. The page's light of
// clouds from sky and ground is that above and below each point alone, where the preview's comes from all around.
const views = {
    clouds: {...common, position: [0, 0, 200], pitch: 15, sun_elevation: 20, bound: 8.5},
    evening: {...common, position: [0, 0, 200], pitch: 15, sun_elevation: 4, bound: 11.8},
    clear_sky: {...common, position: [0, 0, 3000], pitch: 30, sun_elevation: 20, bound: 0.6},
    ground: {...common, position: [0, 0, 1000], pitch: -40, sun_elevation: 20, bound: 0.65},
};

// Draws a view by the program; returns the picture's path below the test's folder.
function preview(name) {
    const {position, heading, pitch, fov, sun_elevation, sun_azimuth, exposure} = views[name];
    const camera = `position=0m,0m,${position[2]}m heading=${heading}deg pitch=${pitch}deg fov=${fov}deg`;
    execFileSync(program, ['preview', path.join(work, 'baked'), '-o', path.join(work, `preview_${name}`), '-q',
        '--camera', camera, '--size', size.join('x'), '--exposure', String(Math.log2(exposure)),
        '--sun-elevation', String(sun_elevation), '--sun-azimuth', String(sun_azimuth)]);
    return `preview_${name}/cloud_lit_sun_${sun_elevation}.png`;
}

// A copy of the bake in which one file has its rows, or a volume its slices, in the opposite order.
function upside_down(name) {
    const copy = path.join(work, `flipped_${name}`);
    fs.cpSync(path.join(work, 'baked'), copy, {recursive: true});
    const manifest = JSON.parse(fs.readFileSync(path.join(copy, 'manifest.json'), 'utf8'));
    const count = manifest.assets.find((asset) => asset.name === name).size.at(-1);
    const file = path.join(copy, `${name}.bin`), bytes = fs.readFileSync(file), length = bytes.length / count;
    const rows = Array.from({length: count}, (_, i) => bytes.subarray(i * length, (i + 1) * length));
    fs.writeFileSync(file, Buffer.concat(rows.reverse()));
    return path.basename(copy);
}

const draw = (page, folder, view) => page.evaluate(async ([url, view]) => {
    const {renderer} = await import('./example/main.js');
    const canvas = document.createElement('canvas');
    (await renderer(canvas, url))(view);
    return window.reduced(canvas, 2);
}, [`work/${folder}`, view]);

function rms(a, b) {
    let sum = 0;
    a.forEach((value, i) => { sum += i % 4 < 3 ? (value - b[i]) ** 2 : 0; });
    return Math.sqrt(sum / (0.75 * a.length));
}

async function main() {
    execFileSync(path.join(example, 'bake.sh'), [program, path.join(work, 'baked')], {stdio: 'ignore'});
    const {browser, page} = await browser_with_a_page(work, {example, work, page: __dirname},
        '<script src="page/pictures_page.js"></script>');
    const pictures = {};
    const wrong = [];
    const measure = async (folder, name, is_right) => {
        const error = rms(await draw(page, folder, views[name]), pictures[name]);
        console.log(`${folder}, ${name}: RMS ${error.toFixed(2)} of 255`);
        if ((error <= views[name].bound) !== is_right) wrong.push(`${folder}, ${name}`);
    };
    for (const name of Object.keys(views)) {
        pictures[name] = await page.evaluate((url) => window.picture(url), `work/${preview(name)}`);
        await measure('baked', name, true);
    }
    for (const name of ['transmittance', 'multiple_scattering']) await measure(upside_down(name), 'clear_sky', false);
    for (const name of ['cloud', 'cells']) await measure(upside_down(name), 'clouds', false);
    assert.deepEqual(wrong, []);
    assert.deepEqual(page.complaints, []);
    await browser.close();
    fs.rmSync(work, {recursive: true, force: true});
}

main().catch((error) => {
    console.log(error.stack);
    process.exit(1);
});
