'use strict';
// Compares the pictures of `skybake preview --live`, in Chromium without a GPU, with those of the CPU's renderer of
// the same bake from the same camera; tests that it is another picture if a table is upside down or empty, and what a
// reader does with the page's controls.
//   node live_page.js PROGRAM FOLDER [WORDS OF A TEST'S NAME]
const {launched, software_gl} = require('./chromium.js');
const {common, comparison, live, open, patience, program, run, size, spoil, work, write} = require('./live_views.js');
const assert = require('node:assert/strict');
const {execFileSync, spawn, spawnSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {pathToFileURL} = require('node:url');

const [, , , , wanted] = process.argv;

const tables = `
preset = "earth_hillaire"
[bake.transmittance]
size = [64, 32]
[bake.multiple_scattering]
content = "moments"
size = [32, 32]
`;
const cloud = `
[noise.shape]
preset = "nubis_layer"
pack = "shape"
seed = 7
[clouds.cumulus]
preset = "cumulus_humilis"
base_altitude = "1.2 km"
detail = ""
convection = { cells = [48, 48, 8] }
extinction_scale = "90 /km"
[bake.cumulus]
asset = "cloud_volume"
cloud = "cumulus"
size = [128, 128, 16]
formats = ["bin"]
pixel_type = "half"
[bake.cells]
asset = "occupancy"
of = "cumulus"
cell = 4
contents = ["leap"]
formats = ["bin"]
pixel_type = "unorm8"
`;

const views = {
    clouds: {...common, position: [0, 0, 200], pitch: 15, sun_elevation: 20},
    evening: {...common, position: [0, 0, 200], pitch: 15, sun_elevation: 4, exposure: 5},
    above: {...common, position: [0, 0, 3000], pitch: -20, sun_elevation: 40},
    clear_sky: {...common, position: [0, 0, 3000], pitch: 30, sun_elevation: 20},
    shadows: {...common, position: [0, 0, 900], pitch: -30, sun_elevation: 40},
    twilight: {...common, position: [0, 0, 3000], pitch: 10, sun_elevation: -4, exposure: 12},
};

const tests = {
    async 'draws what the CPU renders, and a spoilt table is seen'(browser) {
        execFileSync(program, ['bake', write('cloud.toml', tables + cloud), '-o', path.join(work, 'baked'), '-q']);
        const out = path.join(work, 'of_bake');
        execFileSync(program, ['preview', path.join(work, 'baked'), '--live', '-o', out, '-q']);
        const page = await open(browser, path.join(out, 'index.html'));
        const {measure, wrong} = await comparison(page, 'baked', 'cumulus_lit', views);
        for (const name of Object.keys(views)) await measure('as baked', name, true);
        for (const [name, view] of [['transmittance_table', 'clear_sky'], ['multiple_scattering_table', 'clear_sky'],
            ['cloud_table_0', 'clouds'], ['cells_table_0', 'clouds'],
            ['shift_table', 'clouds']]) {
            for (const how of ['flipped', 'zeroed']) {
                // A phase function that lies in two rows upside down is another layer's; leaps of 0 only cost time.
                if (name === 'cells_table_0' && how === 'zeroed') continue;
                await spoil(page, name, how);
                await measure(`${how} ${name}`, view, false);
            }
        }
        await spoil(page, 'none');
        await measure('as baked again', 'clouds', true);
        assert.deepEqual(wrong, []);
        assert.deepEqual(page.complaints, []);
        assert.deepEqual(page.requests, [pathToFileURL(path.join(out, 'index.html')).href]);
    },

    // Through haze the light depends on direction, by many percent of it.
    async 'marches the moments of haze in each direction'(browser) {
        const haze = '[atmosphere.layers.mie]\nscattering = "4e-5 /m"\nextinction = "4.4e-5 /m"\n';
        const text = tables.replace('\n[bake', `\n${haze}[bake`).replace('"moments"', '"moments"\ndegree = 4') + cloud;
        execFileSync(program, ['bake', write('haze.toml', text), '-o', path.join(work, 'haze'), '-q']);
        const out = path.join(work, 'of_haze');
        execFileSync(program, ['preview', path.join(work, 'haze'), '--live', '-o', out, '-q']);
        const page = await open(browser, path.join(out, 'index.html'));
        const view = {...views.clear_sky, bound: 0.6};
        const {measure, wrong} = await comparison(page, 'haze', 'cumulus_lit', {
            towards: {...view, heading: 105, sun_elevation: 4}, beside: {...view, heading: 15, sun_elevation: 40},
            away: {...view, heading: 285, sun_elevation: 10, pitch: 20}});
        for (const name of ['towards', 'beside', 'away']) await measure('as baked', name, true);
        assert.deepEqual(wrong, []);
    },

    async 'leaps change no picture, only its cost'(browser) {
        const page = await open(browser, path.join(work, 'of_bake', 'index.html'));
        const draw = () => page.evaluate(([view, width, height]) => Array.from(window.skybakeLive.render(view, width, height)), [views.clouds, ...size]);
        const quick = await draw();
        await spoil(page, 'cells_table_0', 'zeroed');
        const slow = await draw();
        const reads = (floats) => floats.reduce((sum, value, i) => sum + (i % 4 === 3 ? value : 0), 0);
        console.log(`    ${(reads(quick) / (size[0] * size[1])).toFixed(1)} reads a pixel, without leaps ${(reads(slow) / (size[0] * size[1])).toFixed(1)}`);
        assert.ok(reads(quick) < 0.8 * reads(slow));
        const differing = quick.filter((value, i) => i % 4 !== 3 && Math.abs(value - slow[i]) > 1e-3 * Math.abs(slow[i]) + 1e-7).length;
        assert.ok(differing < 0.005 * quick.length, `${differing} values differ`);
    },

    async 'draws a sun, and the shadows of clouds'(browser) {
        const page = await open(browser, path.join(work, 'of_bake', 'index.html'));
        const mean = (view) => page.evaluate(([view, width, height]) => {
            const floats = window.skybakeLive.render(view, width, height);
            let sum = 0, most = 0;
            floats.forEach((value, i) => {
                if (i % 4 !== 1) return;
                sum += value;
                most = Math.max(most, value);
            });
            return {mean: sum / (width * height), most};
        }, [view, ...size]);
        const at_sun = {...views.clear_sky, heading: 105, pitch: 20, fov: 20};
        const dark = await mean(at_sun), bright = await mean({...at_sun, disc: true});
        const pixel = (2 * Math.tan(10 * Math.PI / 180) / size[0]) ** 2;
        const sunlight = (bright.mean - dark.mean) * pixel * size[0] * size[1];
        console.log(`    the disc brings ${sunlight.toFixed(3)} of the sun's light`);
        assert.ok(sunlight > 0.3 && sunlight < 1 && bright.most > 1000 * dark.most);
        // A lens scatters a hundredth of what the disc has, and nothing where the sun is behind it.
        const veiled = await mean({...at_sun, glare: true});
        console.log(`    glare brightens the sky about the sun by ${((veiled.mean / dark.mean - 1) * 100).toFixed(1)} %`);
        assert.ok(veiled.mean > 1.05 * dark.mean && veiled.most < 0.1 * bright.most);
        const behind = {...views.clear_sky, heading: 105 + 180, fov: 40};
        assert.deepEqual(await mean({...behind, glare: true, disc: true}), await mean(behind));
        const ground = {...views.above, position: [0, 0, 900], pitch: -45, sun_elevation: 60, shadow: false};
        const lit = await mean(ground), shaded = await mean({...ground, shadow: true});
        console.log(`    the ground has ${(shaded.mean / lit.mean).toFixed(3)} of its light below the clouds`);
        assert.ok(shaded.mean < 0.98 * lit.mean && shaded.mean > 0.2 * lit.mean);
    },

    async 'can be used by keyboard alone'(browser) {
        const page = await open(browser, path.join(work, 'of_bake', 'index.html'));
        const view = () => page.evaluate(() => structuredClone(window.skybakeLive.view));
        const reached = new Set();
        for (let i = 0; i < 25; ++i) {
            await page.keyboard.press('Tab');
            reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.tagName));
        }
        for (const id of ['picture', 'sun_elevation', 'sun_azimuth', 'disc', 'glare', 'extinction', 'shadow', 'single', 'exposure',
            'auto', 'tone_curve', 'fov', 'camera', 'home', 'SUMMARY']) assert.ok(reached.has(id), `${id} of ${[...reached]}`);
        const first = await view();
        await page.focus('#sun_elevation');
        await page.keyboard.press('ArrowRight');
        assert.ok((await view()).sun_elevation > first.sun_elevation);
        await page.focus('#picture');
        const hold = async (key) => {
            const before = await view();
            await page.keyboard.down(key);
            await page.waitForFunction((old) => JSON.stringify(window.skybakeLive.view) !== old, JSON.stringify(before));
            await page.keyboard.up(key);
            return [before, await view()];
        };
        const [at, on] = await hold('w');
        assert.ok(Math.hypot(...on.position.map((x, a) => x - at.position[a])) > 0);
        const [level, up] = await hold('ArrowUp');
        assert.ok(up.pitch > level.pitch);
        await page.focus('#home');
        await page.keyboard.press('Enter');
        assert.deepEqual(await view(), {...first, exposure: (await view()).exposure});
        assert.deepEqual(page.complaints, []);
    },

    async 'turns as the picture is dragged'(browser) {
        const page = await open(browser, path.join(work, 'of_bake', 'index.html'));
        const before = await page.evaluate(() => structuredClone(window.skybakeLive.view));
        await page.mouse.move(100, 100);
        await page.mouse.down();
        await page.mouse.move(150, 120);
        await page.mouse.up();
        const after = await page.evaluate(() => window.skybakeLive.view);
        assert.ok(after.heading > before.heading && after.pitch > before.pitch);
    },

    async 'zooms by the wheel and by two fingers, and takes the text of a camera'(browser) {
        const page = await open(browser, path.join(work, 'of_bake', 'index.html'));
        const view = () => page.evaluate(() => structuredClone(window.skybakeLive.view));
        const first = await view();
        await page.mouse.move(100, 100);
        await page.mouse.wheel(0, -100);
        await page.waitForFunction((fov) => window.skybakeLive.view.fov < fov, first.fov);
        const touch = await page.context().newCDPSession(page), before = await view();
        for (const [type, ...places] of [['touchStart', 100, 200], ['touchMove', 120, 180], ['touchMove', 125, 175], ['touchEnd']]) {
            await touch.send('Input.dispatchTouchEvent', {type, touchPoints: places.map((x, id) => ({x, y: 100, id}))});
        }
        await page.waitForFunction((fov) => window.skybakeLive.view.fov > 1.5 * fov, before.fov);
        assert.equal((await view()).heading, first.heading);
        const write = async (text) => {
            await page.fill('#camera', text);
            await page.keyboard.press('Enter');
            return [await view(), await page.evaluate(() => document.getElementById('camera').validity.valid)];
        };
        const [seen, is_right] = await write('position=1km,-2.5km,300 m heading=30deg fov=45deg');
        assert.deepEqual([seen.position, seen.heading, seen.fov, seen.pitch, is_right], [[1000, -2500, 300], 30, 45, first.pitch, true]);
        for (const wrong of ['heading=30', 'position=1km,2km heading=3deg', 'sun=3deg', '']) {
            assert.deepEqual(await write(wrong), [seen, false]);
        }
        assert.deepEqual(page.complaints, []);
    },

    async 'fits a phone, in light and in dark'(browser) {
        const page = await open(browser, path.join(work, 'of_bake', 'index.html'), {viewport: {width: 400, height: 740}});
        const shades = [];
        for (const colorScheme of ['light', 'dark']) {
            await page.emulateMedia({colorScheme});
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 400);
            const picture = await page.locator('#picture').boundingBox();
            assert.ok(picture.width === 400 && picture.y < 10 && picture.height > 300, JSON.stringify(picture));
            shades.push(await page.evaluate(() => getComputedStyle(document.querySelector('aside')).backgroundColor));
        }
        assert.notEqual(shades[0], shades[1]);
    },

    async 'shows pictures where WebGL 2 is missing'(browser) {
        const context = await browser.newContext();
        const page = await context.newPage();
        await page.addInitScript(() => { HTMLCanvasElement.prototype.getContext = () => null; });
        await page.goto(pathToFileURL(path.join(work, 'of_bake', 'index.html')).href);
        await page.waitForFunction(() => window.skybakeLive.failed);
        assert.match(await page.innerText('#reason'), /no WebGL 2/);
        const box = await page.locator('#stills img').first().boundingBox();
        assert.ok(box.width > 200 && box.height > 100, JSON.stringify(box));
    },

    async 'bakes the tables that a recipe lacks'(browser) {
        const about = async (page) => {
            await page.waitForFunction(() => document.getElementById('about').textContent !== '');
            return page.textContent('#about');
        };
        const clouds_alone = await open(browser, live('clouds_alone', cloud));
        assert.match(await about(clouds_alone), /the preset earth, whose tables were baked for this page/);
        assert.equal(await clouds_alone.evaluate(() => window.skybakeLive.scene.textures.length), 5);
        const one_table = tables.slice(0, tables.indexOf('[bake.multiple'));
        const sky_alone = await open(browser, live('sky_alone', one_table));
        assert.match(await about(sky_alone), /the recipe's atmosphere, whose tables were baked for this page/);
        assert.ok(await sky_alone.evaluate(() => window.skybakeLive.scene.clouds.length === 0 && document.getElementById('clouds').hidden));
        assert.deepEqual([...clouds_alone.complaints, ...sky_alone.complaints], []);
    },

    async 'follows a recipe while the camera stays'(browser) {
        const watched = write('watched.toml', tables), out = path.join(work, 'watched');
        const child = spawn(program, ['preview', watched, '--live', '--watch', '-o', out], {stdio: 'ignore'});
        const ended = new Promise((resolve) => child.on('exit', resolve));
        try {
            while (!fs.existsSync(path.join(out, 'preview_state.js'))) await new Promise((resolve) => setTimeout(resolve, 20));
            const page = await open(browser, path.join(out, 'index.html'));
            const has_albedo = (albedo) => page.waitForFunction((text) => window.skybakeLive.scene.air.includes(text),
                `air_ground_albedo() { return vec3(${albedo}, ${albedo}, ${albedo})`);
            await has_albedo('0.3');
            await page.evaluate(() => { window.skybakeLive.view.heading = 200; });
            fs.writeFileSync(watched, tables.replace('\n[bake', '\n[atmosphere]\nground_albedo = 0.9\n[bake'));
            await has_albedo('0.9');
            assert.equal(await page.evaluate(() => window.skybakeLive.view.heading), 200);
            fs.writeFileSync(watched, tables.replace('size', 'sise'));
            await page.waitForSelector('#diagnostics .diagnostic');
            assert.match(await page.innerText('#diagnostics'), /E0102[^]*sise[^]*did you mean/);
            await has_albedo('0.9');
            fs.writeFileSync(watched, tables);
            await has_albedo('0.3');
            await page.waitForSelector('#diagnostics:not(:has(*))', {state: 'attached'});
            // At rest it ends by itself; amid a bake a busy machine may leave it no time to say so.
            const is_full = () => fs.readFileSync(path.join(out, 'preview_state.js'), 'utf8').includes('"quality":"full"');
            while (!is_full()) await new Promise((resolve) => setTimeout(resolve, 20));
            child.kill('SIGINT');
            assert.equal(await ended, 130);
            await page.waitForSelector('.watch.ended');
            assert.deepEqual(page.complaints, []);
        } finally {
            child.kill('SIGKILL');
        }
    },

    async 'refuses what it cannot show'() {
        const refused = (...given) => {
            const {status, stderr} = spawnSync(program, ['preview', ...given], {encoding: 'utf8'});
            return `${status} ${stderr}`;
        };
        const recipe = path.join(work, 'cloud.toml');
        assert.match(refused(recipe, '--live', '--size', '100x100'), /^2 [^]*--live and --size exclude each other/);
    },
};

(async () => run(await launched(work, patience, ['--disable-gpu', ...software_gl]), tests, wanted))();
