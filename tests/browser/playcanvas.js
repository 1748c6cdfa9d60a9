'use strict';
// Skies of the target playcanvas in Chromium without a GPU: PlayCanvas's own loaders read the Radiance panorama and the
// cube, cameras see the values of the manifest's probes in their directions, and the suns light planes as they should.
//   node playcanvas.js PROGRAM FOLDER
const {browser_with_a_page} = require('./page_of.js');
const {cube_probes, direction_of} = require('./cube_probes.js');
const {faults_of_lamp, normals_of} = require('./lit_planes.js');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const [, , program, folder] = process.argv;

// PlayCanvas makes a cube of 8 bits of a panorama, whose texels it does not blend, so that what is seen is up to half a
// texel elsewhere, where the light changes most at the horizon. It takes cubes as they are.
const probes_of = {
    panorama: (asset) => asset.probes.filter(({uv: [, v]}) => Math.abs(v - 0.5) > 2 / 128)
        .map((probe) => ({...probe, direction: direction_of(probe)})),
    cube: (asset) => cube_probes(asset, 1),
};
const allowed = {panorama: (value) => 0.06 * value, cube: (value, tolerance) => tolerance + 1e-3 * value};

// PlayCanvas has straight ahead at +z and right at -x.
const world = ([right, up, ahead]) => [-right, up, ahead];

async function faults_of(page, asset) {
    const name = asset.name;
    const probes = probes_of[name](asset);
    const url = `/baked/${asset.files.find(({format}) => format === 'sidecar').path}`;
    const values = await page.evaluate(([module, views]) => window.look(module, views),
        [url, probes.map(({direction}) => world(direction))]);
    const faults = probes.flatMap(({value, tolerance, direction}, i) => value.flatMap((wanted, c) =>
        Math.abs(values[i][c] - wanted) <= allowed[name](wanted, tolerance[c]) ? [] :
            [`${name}, towards ${direction}: ${values[i][c]} is not ${wanted}`]));
    const lit = await page.evaluate(([module, normals]) => window.light(module, normals), [url, normals_of(asset).map(world)]);
    faults.push(...faults_of_lamp(asset, lit, (light) => light, 0.005 * Math.max(...asset.details.sun_irradiance)));
    if (probes.length < 6) faults.push(`${name}: ${probes.length} probes are few`);
    return faults;
}

async function main() {
    const work = fs.mkdtempSync(path.join(folder, 'playcanvas-'));
    const baked = path.join(work, 'baked');
    execFileSync(program, ['bake', path.join(__dirname, 'playcanvas.toml'), '-o', baked, '-q', '--certify=off'],
        {stdio: 'inherit'});
    const {assets} = JSON.parse(fs.readFileSync(path.join(baked, 'manifest.json'), 'utf8'));
    const {browser, page} = await browser_with_a_page(work,
        {playcanvas: path.join(folder, 'node_modules', 'playcanvas', 'build'), baked, page: __dirname},
        '<script type="module" src="/page/playcanvas_page.js"></script>');
    await page.waitForFunction(() => window.look);
    const faults = [];
    for (const asset of assets) faults.push(...await faults_of(page, asset));
    faults.push(...page.complaints);
    await browser.close();
    console.log(faults.length > 0 ? faults.join('\n') : `${assets.length} skies in PlayCanvas`);
    fs.rmSync(work, {recursive: true, force: true});
    process.exit(faults.length > 0 ? 1 : 0);
}

main();
