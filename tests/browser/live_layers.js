'use strict';
// Several layers of clouds on one live page, beside the picture of one sky that the CPU's renderer makes of the same
// bake from the same camera.
//   node live_layers.js PROGRAM FOLDER [WORDS OF A TEST'S NAME]
const {launched, software_gl} = require('./chromium.js');
const {common, comparison, live, open, patience, program, run, spoil, work, write} = require('./live_views.js');
const assert = require('node:assert/strict');
const {execFileSync} = require('node:child_process');
const path = require('node:path');

const [, , , , wanted] = process.argv;

const air = `
preset = "earth_hillaire"
[bake.transmittance]
size = [64, 32]
[bake.multiple_scattering]
mapping = "twilight"
size = [32, 32]
[noise.shape]
preset = "nubis_layer"
pack = "shape"
seed = 7
`;
const layer = (name, size, words) => `
[clouds.${name}]
noise = "shape"
detail = ""
${words}
[bake.${name}]
asset = "cloud_volume"
cloud = "${name}"
size = [${size}]
formats = ["bin"]
pixel_type = "half"
`;
// It grows, so it takes no noise.
const cumulus = layer('cumulus', [96, 96, 12], 'preset = "cumulus_humilis"\nbase_altitude = "1.2 km"\nconvection = { cells = [48, 48, 8] }')
    .replace('noise = "shape"\n', '');
const grid = '[bake.cells]\nasset = "occupancy"\nof = "cumulus"\ncell = 4\ncontents = ["leap"]\nformats = ["bin"]\n';
const overlapping = layer('overlapping', [64, 80, 12],
    'extent = ["4 km", "5 km", "0.9 km"]\nbase_altitude = "1.6 km"\ncoverage = 0.4\nextinction_scale = "20 /km"');
const high = layer('high', [60, 72, 8],
    'extent = ["9 km", "7 km", "0.6 km"]\nbase_altitude = "5 km"\ncoverage = 0.3\nextinction_scale = "6 /km"');

const below = {...common, position: [0, 0, 200], pitch: 15, sun_elevation: 20};
const between = {...common, position: [500, 900, 4000], heading: 20, pitch: -25, sun_elevation: 50};
const scenes = {
    two: {recipe: air + cumulus + grid + high, views: {
        below, evening: {...below, sun_elevation: 4, exposure: 5}, horizon: {...below, position: [0, 0, 600], pitch: 3, fov: 30},
        between}},
    three: {recipe: air + cumulus + overlapping + high, views: {
        inside: {...common, position: [700, 300, 1800], pitch: 5, sun_elevation: 30},
        above: {...common, position: [500, 900, 9000], pitch: -35, sun_elevation: 35},
        dusk: {...below, sun_elevation: -3, exposure: 11}}},
};

async function page_of_scene(browser, name) {
    execFileSync(program, ['bake', write(`${name}.toml`, scenes[name].recipe), '-o', path.join(work, name), '-q'], {stdio: 'pipe'});
    const out = path.join(work, `live_${name}`);
    execFileSync(program, ['preview', path.join(work, name), '--live', '-o', out, '-q'], {stdio: 'pipe'});
    return open(browser, path.join(out, 'index.html'));
}

const tests = {
    async 'draws two layers as the CPU does, and a spoilt table is seen'(browser) {
        const page = await page_of_scene(browser, 'two');
        const {measure, wrong} = await comparison(page, 'two', 'scene', scenes.two.views);
        for (const name of Object.keys(scenes.two.views)) await measure('as baked', name, true);
        // The high layer is nearly the same upside down, and the leaps of its two rows of cells are equal.
        for (const [table, hows] of [['cloud_table_0', ['flipped', 'zeroed']], ['cloud_table_1', ['shifted', 'zeroed']],
            ['cells_table_0', ['flipped']], ['cells_table_1', ['filled']], ['shift_table', ['zeroed']]]) {
            for (const how of hows) {
                await spoil(page, table, how);
                await measure(`${how} ${table}`, 'below', false);
            }
        }
        assert.deepEqual(wrong, []);
        assert.deepEqual(page.complaints, []);
    },

    async 'draws three layers that overlap as the CPU does'(browser) {
        const page = await page_of_scene(browser, 'three');
        const {measure, wrong} = await comparison(page, 'three', 'scene', scenes.three.views);
        for (const name of Object.keys(scenes.three.views)) await measure('as baked', name, true);
        assert.deepEqual(wrong, []);
        assert.deepEqual(page.complaints, []);
    },

    async 'says that a browser has too few textures, and shows pictures'(browser) {
        const file = live('many', air + ['a', 'b', 'c', 'd', 'e', 'f'].map((name) => layer(name, [8, 8, 4],
            'extent = ["2 km", "2 km", "0.5 km"]\nbase_altitude = "1 km"\ncoverage = 0.5')).join(''));
        const context = await browser.newContext(), page = await context.newPage();
        await page.addInitScript(() => {
            const whole = WebGL2RenderingContext.prototype.getParameter;
            WebGL2RenderingContext.prototype.getParameter = function (name) {
                return name === this.MAX_TEXTURE_IMAGE_UNITS ? 16 : whole.call(this, name);
            };
        });
        await page.goto(`file://${file}`);
        await page.waitForFunction(() => window.skybakeLive.failed);
        assert.match(await page.innerText('#reason'), /6 layers of clouds need 18 textures at once, and this browser has 16/);
    },
};

(async () => run(await launched(work, patience, ['--disable-gpu', ...software_gl]), tests, wanted))();
