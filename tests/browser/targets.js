'use strict';
// Loads the files of a web target by its own modules in Chromium without a GPU: every texture has, at the places
// of the probes, the values that the manifest says. Cubes are read by direction alone.
//   node targets.js PROGRAM FOLDER TARGET
const {browser_with_a_page} = require('./page_of.js');
const {cube_probes} = require('./cube_probes.js');
const {faults_of_lamp, normals_of} = require('./lit_planes.js');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const [, , program, folder, target] = process.argv;
const work = fs.mkdtempSync(path.join(folder, `target-${target}-`));
const modules = path.join(folder, 'node_modules');
const three = `<script type="importmap">${JSON.stringify({imports: {
        'three': '/modules/three/build/three.module.js', 'three/addons/': '/modules/three/examples/jsm/'}})}</script>`;
const scripts = {
    three, takram: three,
    babylon: '<script src="/modules/babylonjs/babylon.js"></script>',
};

// The places of all lookups of an asset's probes: x, y, z and 0 each. The loader of EXR files turns their rows, so
// that v runs up.
function places_of(asset) {
    const lookups = asset.probes.flatMap((probe) => [probe.uvw ?? probe.uv, ...(probe.blend ? [probe.blend.uvw] : [])]);
    const runs_up = asset.files[0].format === 'exr';
    return lookups.flatMap(([u, v, w]) => [u, runs_up ? 1 - v : v, w ?? 0.5, 0]);
}

// Returns the faults of the values that were found at those places.
function faults_of(asset, values) {
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

// Returns the faults of a cube: of its values by direction, and of the sky that the program draws of it. The module of
// Babylon.js loads the first level.
async function faults_of_cube(page, asset, url) {
    const probes = cube_probes(asset, target === 'three' ? asset.mips.length + 1 : 1);
    const faces = new Set(probes.map((probe) => `${probe.level}, ${probe.face}`));
    const places = probes.flatMap(({direction, level}) => [...direction, level]);
    const values = await page.evaluate(([name, ...rest]) => window.look_up[name](...rest), [target, url, 'Cube', places]);
    const faults = faults_of({name: asset.name, probes}, values);
    if (faces.size < 6 || probes.length < 12) faults.push(`${asset.name}: ${probes.length} probes in ${faces.size} faces`);
    if (!(target in skies)) return faults;
    const seen = probes.filter(({level}) => level === 0);
    const views = seen.map(({direction: [right, up, ahead]}) => skies[target](right, up, ahead));
    const sky = await page.evaluate(([name, ...rest]) => window.look_at_sky[name](...rest), [target, url, views]);
    return [...faults, ...faults_of({name: `${asset.name} as background`, probes: seen}, sky)];
}

// Where (right, up, ahead) is in the world of a program that draws a sky.
const skies = {three: (right, up, ahead) => [-right, up, ahead]};

// The same for the lamps of cubes and of panoramas, of which Babylon.js turns the left-handed ones.
const worlds = {
    three: {cube: skies.three, longitude_latitude: (right, up, ahead) => [ahead, up, right]},
    babylon: {cube: (right, up, ahead) => [right, up, ahead], longitude_latitude: (right, up, ahead) => [ahead, up, -right]},
};

// Returns the faults of the lamp in the place of the sun.
async function faults_of_sun(page, asset, url) {
    const world = worlds[target][asset.mapping.name];
    const values = await page.evaluate(([name, ...rest]) => window.light[name](...rest),
        [target, url, normals_of(asset).map((normal) => world(...normal))]);
    return faults_of_lamp(asset, values, (light) => light, 0.005 * Math.max(...asset.details.sun_irradiance));
}

async function main() {
    const recipe = target === 'takram' ? 'target_takram.toml' : 'targets.toml';
    execFileSync(program, ['bake', path.join(__dirname, recipe), '-o', path.join(work, 'baked'), '-q',
                           '--certify=off', '--set', `target="${target}"`], {stdio: 'inherit'});
    const manifest = JSON.parse(fs.readFileSync(path.join(work, 'baked', 'manifest.json'), 'utf8'));
    const {browser, page} = await browser_with_a_page(work,
        {modules, baked: path.join(work, 'baked'), page: __dirname},
        `${scripts[target]}<script type="module" src="/page/targets_page.js"></script>`);
    await page.waitForFunction(() => window.look_up);
    const faults = [];
    let probes = 0, lamps = 0;
    for (const asset of manifest.assets) {
        const sidecar = asset.files.find((file) => file.format === 'sidecar');
        probes += asset.probes.length;
        if (asset.kind === 'environment') {
            faults.push(...await faults_of_sun(page, asset, `/baked/${sidecar.path}`));
            ++lamps;
        }
        if (asset.mapping.name === 'cube') {
            faults.push(...await faults_of_cube(page, asset, `/baked/${sidecar.path}`));
            continue;
        }
        // Flat volumes are 2-D textures in takram's packages.
        const dim = target === 'takram' && asset.size[2] === 1 ? 2 : asset.size.length;
        const values = await page.evaluate(([name, ...rest]) => window.look_up[name](...rest),
            [target, `/baked/${sidecar.path}`, dim, places_of(asset)]);
        faults.push(...faults_of(asset, values));
    }
    faults.push(...page.complaints);
    await browser.close();
    console.log(faults.length > 0 ? faults.join('\n') : `${manifest.assets.length} assets, ${probes} probes`);
    fs.rmSync(work, {recursive: true, force: true});
    process.exit(faults.length > 0 || probes < 60 || (target in worlds && lamps < 2) ? 1 : 0);
}

main();
