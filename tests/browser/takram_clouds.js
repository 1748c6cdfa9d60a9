'use strict';
// Every texture that @takram/three-clouds loads, from skybake, through the package's own loaders in Chromium without a
// GPU: at the places of the probes they have the values that the manifest says. The package draws its clouds with them,
// none without weather, as bright ones as with its own textures, and others where a texture is wrong.
//   node takram_clouds.js PROGRAM FOLDER probes|pictures
const {browser_with_a_page} = require('./page_of.js');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const [, , program, folder, what] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'takram-clouds-'));
const modules = path.join(folder, 'node_modules');
const recipe = path.join(__dirname, '..', '..', 'examples', 'takram_clouds.toml');

const imports = {
    'three': 'three/build/three.module.js',
    'three/addons/': 'three/examples/jsm/',
    'postprocessing': 'postprocessing/build/index.js',
    '@takram/three-atmosphere': '@takram/three-atmosphere/build/index.js',
    '@takram/three-atmosphere/shaders/bruneton': '@takram/three-atmosphere/build/shaders/bruneton.js',
    '@takram/three-clouds': '@takram/three-clouds/build/index.js',
    '@takram/three-geospatial': '@takram/three-geospatial/build/index.js',
    '@takram/three-geospatial/shaders': '@takram/three-geospatial/build/shaders.js',
};
for (const name of Object.keys(imports)) imports[name] = `/modules/${imports[name]}`;

// The package's textures, as its loaders and its own files describe them.
const expected = {
    local_weather: {path: 'local_weather.png', size: [512, 512], channels: 4},
    shape: {path: 'shape.bin', size: [128, 128, 128], channels: 1},
    shape_detail: {path: 'shape_detail.bin', size: [32, 32, 32], channels: 1},
    turbulence: {path: 'turbulence.png', size: [128, 128], channels: 3},
    stbn: {path: 'stbn.bin', size: [128, 128, 64], channels: 1},
};

const places_of = (asset) => asset.probes.flatMap((probe) => {
    const [u, v, w] = probe.uvw ?? probe.uv;
    return [u, v, w ?? 0, 0];
});

function faults_of(asset, found) {
    return asset.probes.flatMap((probe, i) => probe.value.flatMap((value, c) => {
        const difference = Math.abs(found[4 * i + c] - value);
        return difference <= probe.tolerance[c] ? [] :
            [`${asset.name}, probe ${i}: ${found[4 * i + c]} is not ${value} ± ${probe.tolerance[c]}`];
    }));
}

// Returns the faults of the files by themselves.
function faults_of_files(asset) {
    const wanted = expected[asset.name];
    const file = asset.files.find((one) => one.format !== 'sidecar');
    const found = {path: file.path, size: asset.size, channels: asset.channels.length};
    return JSON.stringify(found) === JSON.stringify(wanted) ? [] :
        [`${asset.name}: ${JSON.stringify(found)}, not ${JSON.stringify(wanted)}`];
}

const size = [48, 32];
const own = '/modules/@takram/three-clouds/assets/';  // has all but stbn
const names = ['local_weather', 'shape', 'shape_detail', 'turbulence', 'stbn'];
const wrong = [['local_weather', 'nothing'], ...names.flatMap((name) => [[name, 'zeros'], [name, 'reversed']]), ['stbn', 'nothing']];

function draw(page, folder_of, changes) {
    const folders = Object.fromEntries(names.map((name) => [name, folder_of(name)]));
    return page.evaluate((options) => window.draw_clouds(options),
        {folders, atmosphere: '/modules/@takram/three-atmosphere/assets', size, wrong: changes});
}

const mean_of = (picture, channel) => {
    let sum = 0;
    for (let i = channel; i < picture.length; i += 4) sum += picture[i];
    return sum / (picture.length / 4);
};

// The mean difference of how much the clouds of two pictures cover.
function difference_of(one, other) {
    return mean_of(one.map((value, i) => Math.abs(value - other[i])), 3);
}

// Returns the faults of the pictures: nothing stands for a texture that was loaded once more.
function faults_of_pictures([right, ...pictures]) {
    return pictures.flatMap((picture, i) => {
        const [name, change] = wrong[i];
        const difference = difference_of(picture, right);
        const is_empty = picture.every((value) => value === 0);
        const must_be_empty = name === 'local_weather' && change === 'zeros';
        const is_right = change === 'nothing' ? difference < 1e-4 : difference > 1e-3 && is_empty === must_be_empty;
        console.log(`${name}, ${change}: ${difference.toFixed(5)} of the picture`);
        return is_right ? [] : [`${name}, ${change}: the picture differs by ${difference}${is_empty ? ' and is empty' : ''}`];
    });
}

// How bright what is covered is, over that with the package's own textures.
function faults_of_look(picture, its_own) {
    const cover = mean_of(picture, 3);
    const light = mean_of(picture, 1) / cover / (mean_of(its_own, 1) / mean_of(its_own, 3));
    console.log(`${cover.toFixed(3)} of the sky is cloud, ${light.toFixed(3)} as bright as with the package's own textures`);
    return cover > 0.05 && cover < 0.95 && light > 0.8 && light < 1.25 ? [] : [`cover ${cover}, light ${light}`];
}

async function faults_of_clouds(page) {
    const pictures = await draw(page, () => '/baked/', wrong);
    const [its_own] = await draw(page, (name) => name === 'stbn' ? '/baked/' : own, []);
    return [...faults_of_pictures(pictures), ...faults_of_look(pictures[0], its_own)];
}

async function faults_of_probes(page, assets) {
    const faults = [];
    let probes = 0;
    for (const name of Object.keys(expected)) {
        const asset = assets.find((one) => one.name === name);
        faults.push(...faults_of_files(asset));
        const url = `/baked/${expected[name].path}`;
        const look_up = (turned) => page.evaluate(([which, from, places, upside_down]) =>
            window.look_up(which, from, places, upside_down), [name, url, places_of(asset), turned]);
        faults.push(...faults_of(asset, await look_up(false)));
        // A test that cannot fail would accept rows in the wrong order too.
        if (faults_of(asset, await look_up(true)).length === 0) faults.push(`${name}: upside down, it passes`);
        probes += asset.probes.length;
    }
    console.log(`${probes} probes of five textures`);
    return probes < 80 ? [...faults, 'there are too few probes'] : faults;
}

async function main() {
    execFileSync(program, ['bake', recipe, '-o', path.join(work, 'baked'), '-q', '--certify=off'], {stdio: 'inherit'});
    const {assets} = JSON.parse(fs.readFileSync(path.join(work, 'baked', 'manifest.json'), 'utf8'));
    const {browser, page} = await browser_with_a_page(work,
        {modules, baked: path.join(work, 'baked'), page: __dirname},
        `<script type="importmap">${JSON.stringify({imports})}</script>
         <script type="module" src="/page/takram_clouds_page.js"></script>`);
    await page.waitForFunction(() => window.look_up).catch((error) => {
        throw new Error([error.message, ...page.complaints].join('\n'));
    });
    const faults = what === 'probes' ? await faults_of_probes(page, assets) : await faults_of_clouds(page);
    faults.push(...page.complaints);
    await browser.close();
    console.log(faults.join('\n'));
    fs.rmSync(work, {recursive: true, force: true});
    process.exit(faults.length > 0 ? 1 : 0);
}

main();
