'use strict';
// Live pages in Chromium without a GPU, beside pictures of the CPU's renderer.
const assert = require('node:assert/strict');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {pathToFileURL} = require('node:url');

const [, , program, folder] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'live-'));
const patience = 1800000;  // ms; nothing here is a test of time, this ends what hangs

// The root mean square of differences that the page may have from the renderer's picture, in bytes of 255: 1 %.
const bound = 2.55;
// Small pictures have four samples for each pixel in the preview, and so here.
const size = [96, 54];
const common = {heading: 63, fov: 70, sun_azimuth: 105, exposure: 3.5, disc: false, glare: false, shadow: true};

function write(name, text) {
    const file = path.join(work, name);
    fs.writeFileSync(file, text);
    return file;
}

// Writes a live page; returns its path.
function live(name, text, more = []) {
    const out = path.join(work, name);
    execFileSync(program, ['preview', write(`${name}.toml`, text), '--live', '-o', out, '-q', ...more], {stdio: 'pipe'});
    return path.join(out, 'index.html');
}

// Draws a view of a bake by the CPU's renderer; returns its picture of that name as a data URL.
function rendered(baked, picture, name, view) {
    const {position, heading, pitch, fov, sun_elevation, sun_azimuth, exposure} = view;
    const camera = `position=${position.map((x) => `${x}m`).join(',')} heading=${heading}deg pitch=${pitch}deg fov=${fov}deg`;
    const out = path.join(work, `rendered_${baked}_${name}`);
    execFileSync(program, ['preview', path.join(work, baked), '-o', out, '-q', '--table-sky', '--camera', camera, '--size', size.join('x'),
        '--exposure', String(exposure), '--sun-elevation', String(sun_elevation), '--sun-azimuth', String(sun_azimuth)], {stdio: 'pipe'});
    const png = fs.readFileSync(path.join(out, `${picture}_sun_${String(sun_elevation).replace('-', 'minus_')}.png`));
    return `data:image/png;base64,${png.toString('base64')}`;
}

// A page that listens to itself: what it complains of, and what it asks the world for.
async function open(browser, file, options = {}) {
    const context = await browser.newContext({viewport: {width: 640, height: 480}, ...options});
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    page.complaints = [];
    page.requests = [];
    page.on('console', (message) => {
        if (message.type() === 'error') page.complaints.push(message.text());
    });
    page.on('pageerror', (error) => page.complaints.push(error.stack));
    page.on('request', (request) => {
        if (!/^(data|blob):/.test(request.url())) page.requests.push(request.url());
    });
    await page.goto(pathToFileURL(file).href);
    await page.waitForFunction(() => window.skybakeLive.painted || window.skybakeLive.failed);
    assert.equal(await page.evaluate(() => window.skybakeLive.failed), undefined);
    return page;
}

// The places of the renderer's four samples in a pixel, from its middle, in pixels to the right and down. Each further
// sample shifts the noise by a quarter.
const places = [[0, 0], [0.35, 0], [-0.175, 0.303], [-0.175, -0.303]];
const samples = places.map(([x, y], i) => ({offset: [x, -y], rank: i / 4 / 0.618034}));

// A view as the page draws it, with the renderer's samples: their mean light, in bytes by the default curve (of Uchimura
// 2017, with the path to white of Khronos PBR Neutral) and the Reference Gamut Compression of ACES 1.3. The page's own bytes of the samples must be those of their light, but for the
// dither.
const drawn = (page, view) => page.evaluate(([view, width, height, samples]) => {
    const threshold = [0.815, 0.803, 0.88], limit = [1.147, 1.264, 1.312], power = 1.2;
    const compressed = (distance, c) => {
        if (distance <= threshold[c]) return distance;
        const reach = limit[c] - threshold[c];
        const scale = reach / (((1 - threshold[c]) / reach) ** -power - 1) ** (1 / power);
        const x = (distance - threshold[c]) / scale;
        return threshold[c] + scale * x / (1 + x ** power) ** (1 / power);
    };
    const film = (x) => {
        if (x >= 0.532) return 1 - 0.468 * Math.exp((0.532 - x) / 0.468);
        const place = Math.min(x / 0.22, 1), linear = place * place * (3 - 2 * place);
        return linear * x + (1 - linear) * 0.22 * place ** 1.33;
    };
    const byte = (_, i, light) => {
        if ((i & 3) === 3) return 255;
        const pixel = light.slice(i & ~3, (i & ~3) + 3), greatest = Math.max(...pixel);
        const exposed = (linear, c) => 2 ** view.exposure *
            Math.max(greatest > 0 ? greatest * (1 - compressed((greatest - linear) / greatest, c)) : linear, 0);
        const own = exposed(pixel[i & 3], i & 3), most = Math.max(...Array.from(pixel, exposed), 0);
        const peak = film(most), colored = 1 / (1 + 0.15 * (most - peak));
        const shown = most > 0 ? 0.85 * peak * (colored * own / most + 1 - colored) + 0.15 * film(own) : 0;
        return 255 * (shown <= 0.0031308 ? 12.92 * shown : 1.055 * shown ** (1 / 2.4) - 0.055);
    };
    const means = new Array(4 * width * height).fill(0);
    let farthest = 0;
    for (const sample of samples) {
        const light = window.skybakeLive.render(view, width, height, sample);
        const bytes = window.reduced(document.getElementById('picture'), 1);
        for (let i = 0; i < means.length; ++i) {
            const row = Math.floor(i / (4 * width));
            const at = 4 * width * (height - 1 - row) + i % (4 * width);  // their row 0 is at the bottom
            if ((i & 3) < 3) farthest = Math.max(farthest, Math.abs(byte(light[at], at, light) - bytes[i]));
            means[i] += light[at] / samples.length;
        }
    }
    return {bytes: means.map(byte), farthest};
}, [view, ...size, samples]);

function rms(a, b) {
    let sum = 0;
    a.forEach((value, i) => { sum += i % 4 < 3 ? (value - b[i]) ** 2 : 0; });
    return Math.sqrt(sum / (0.75 * a.length));
}

// Loads the page's scene again with a texture that is upside down, all zeros, filled with bytes of 60, or half a tile
// further along y.
const spoil = (page, name, how) => page.evaluate(async ([name, how]) => {
    const scene = JSON.parse(document.getElementById('scene').textContent);
    const texture = scene.textures.find((one) => one.name === name);
    if (texture) {
        const bytes = new Uint8Array(await unpacked(texture.texels)), length = bytes.length / texture.size.at(-1);
        const spoilt = new Uint8Array(bytes.length).fill(how === 'filled' ? 60 : 0);
        for (let row = 0; how === 'flipped' && row < texture.size.at(-1); ++row) {
            spoilt.set(bytes.subarray(row * length, (row + 1) * length), bytes.length - (row + 1) * length);
        }
        if (how === 'shifted') {
            const half = Math.floor(texture.size[1] / 2) * length / texture.size[1];
            bytes.forEach((byte, i) => { spoilt[i - i % length + (i % length + half) % length] = byte; });
        }
        const stream = new Blob([spoilt]).stream().pipeThrough(new CompressionStream('deflate'));
        const packed = new Uint8Array(await new Response(stream).arrayBuffer());
        let text = '';
        for (const byte of packed) text += String.fromCharCode(byte);
        texture.texels = btoa(text);
    }
    await window.skybakeLive.replace(scene);
}, [name, how]);

// Measures how far views of a page are from the renderer's pictures. `is_right` says whether they must be within the
// bound; `wrong` collects those that are not as they should be.
async function comparison(page, baked, picture, views) {
    await page.addScriptTag({path: path.join(__dirname, 'pictures_page.js')});
    // Scenes with spoilt tables have the same programs, and compiling them takes most of the time without a GPU.
    await page.evaluate(() => {
        const {renderer} = window.skybakeLive, made = new Map(), compiled = renderer.program;
        renderer.program = (text) => made.get(text) ?? made.set(text, compiled.call(renderer, text)).get(text);
    });
    const pictures = {}, wrong = [];
    const measure = async (what, name, is_right) => {
        pictures[name] ??= await page.evaluate((url) => window.picture(url), rendered(baked, picture, name, views[name]));
        const {bytes, farthest} = await drawn(page, views[name]);
        assert.ok(farthest < 1.5, `${farthest} bytes between the light and the screen`);
        const error = rms(bytes, pictures[name]);
        console.log(`    ${what}, ${name}: RMS ${error.toFixed(2)} of 255`);
        if ((error <= (views[name].bound ?? bound)) !== is_right) wrong.push(`${what}, ${name}`);
    };
    return {measure, wrong};
}

// Runs the tests whose names contain `wanted`, and ends the process.
async function run(browser, tests, wanted = '') {
    let failed = 0;
    for (const [name, test] of Object.entries(tests).filter(([name]) => name.includes(wanted))) {
        try {
            await test(browser);
            console.log(`ok    ${name}`);
        } catch (error) {
            ++failed;
            console.log(`FAIL  ${name}\n${error.stack}`);
        }
        for (const context of browser.contexts()) await context.close();
    }
    await browser.close();
    if (failed === 0) fs.rmSync(work, {recursive: true, force: true});
    process.exit(failed === 0 ? 0 : 1);
}

module.exports = {bound, common, comparison, live, open, patience, program, run, size, spoil, work, write};
