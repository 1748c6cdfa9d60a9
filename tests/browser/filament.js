'use strict';
// An environment in Filament: cmgen makes its cube map, and Filament draws it as the sky in Chromium without a GPU. In
// the directions of the manifest's probes the picture is as bright as they say, within the digits of the cube map's
// texels, R11 G11 B10, and of the canvas.
//   node filament.js PROGRAM FOLDER
const {browser_with_a_page} = require('./page_of.js');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const [, , program, folder] = process.argv;
const cmgen = '/usr/bin/cmgen';

// Returns the direction of a place in the picture. Filament's y points up, and the middle of the picture is at its
// +z; from within, u grows to the right, towards -x.
function direction_of([u, v]) {
    const azimuth = (2 * u - 1) * Math.PI, elevation = (0.5 - v) * Math.PI;
    return [-Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation), Math.cos(azimuth) * Math.cos(elevation)];
}

// The cube map has the sky's sharp horizon half a texel elsewhere.
const is_off_horizon = ({uv: [, v]}) => Math.abs(v - 0.5) > 3 / 180;

async function main() {
    if (!fs.existsSync(cmgen)) {
        console.log('skipped: there is no /usr/bin/cmgen (libfilament-tools)');
        process.exit(77);
    }
    const work = fs.mkdtempSync(path.join(folder, 'filament-'));
    const baked = path.join(work, 'baked');
    execFileSync(program, ['bake', path.join(__dirname, 'filament.toml'), '-o', baked, '-q', '--certify=off'],
        {stdio: 'inherit'});
    const [asset] = JSON.parse(fs.readFileSync(path.join(baked, 'manifest.json'), 'utf8')).assets;
    execFileSync(cmgen, ['-q', '-x', path.join(work, 'cube'), '--format=ktx', '--size=256', '--ibl-samples=16',
                         path.join(baked, asset.files[0].path)], {stdio: 'inherit'});
    const probes = asset.probes.filter(is_off_horizon);
    const scale = 1 / Math.max(...probes.flatMap(({value}) => value));
    const {browser, page} = await browser_with_a_page(work,
        {filament: path.join(folder, 'node_modules', 'filament'), work, page: __dirname},
        `<canvas id="canvas" width="32" height="32"></canvas><script src="/filament/filament.js"></script>
         <script src="/page/filament_page.js"></script>`);
    const colors = await page.evaluate(([url, directions, brightness]) => window.look(url, directions, brightness),
        ['/work/cube/cube_skybox.ktx', probes.map(({uv}) => direction_of(uv)), scale]);
    const faults = probes.flatMap(({value, uv}, i) => value.flatMap((radiance, c) => {
        const wanted = radiance * scale, found = colors[i][c] / 255;
        return Math.abs(found - wanted) <= 0.04 * wanted + 1.5 / 255 ? [] :
            [`at ${uv}, channel ${c}: ${found} is not ${wanted}`];
    }));
    faults.push(...page.complaints);
    await browser.close();
    console.log(faults.length > 0 ? faults.join('\n') : `${probes.length} probes in Filament`);
    fs.rmSync(work, {recursive: true, force: true});
    process.exit(faults.length > 0 || probes.length < 12 ? 1 : 0);
}

main();
