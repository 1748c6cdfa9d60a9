'use strict';
// Pages of `skybake preview` in Chromium, from file://.
const fs = require('node:fs');
const path = require('node:path');
const {pathToFileURL} = require('node:url');

const [, , program, folder] = process.argv;
const work = fs.mkdtempSync(path.join(folder, 'pages-'));
const patience = 300000;  // ms; nothing here is a test of time, this ends what hangs

const noise = `
[noise.shape]
seed = 7
[noise.shape.channels.Y]
type = "perlin_worley"
frequency = 2
octaves = 1
worley_frequency = 2
worley_octaves = 1
`;
const recipe = `
preset = "earth_hillaire"
${noise}
[clouds.cumulus]
preset = "stratocumulus"
extent = ["10 km", "10 km", "1.25 km"]
noise = "shape"
noise_scale = [1, 1, 1]
detail = ""
[bake.transmittance]
size = [64, 16]
[bake.multiple_scattering]
size = [16, 16]
[bake.shape]
asset = "noise_volume"
noise = "shape"
size = [32, 32, 32]
[bake.cumulus]
asset = "cloud_volume"
cloud = "cumulus"
size = [64, 64, 8]
[bake.cumulus_occupancy]
asset = "occupancy"
of = "cumulus"
`;

function write(name, text) {
    const file = path.join(work, name);
    fs.writeFileSync(file, text);
    return file;
}

// A page that listens to itself: whatever it complains of, and whatever it asks the world for.
async function open(browser, file, options = {}) {
    const context = await browser.newContext({viewport: {width: 1280, height: 900}, ...options});
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    page.complaints = [];
    page.requests = [];
    page.on('console', (message) => {
        if (['error', 'warning'].includes(message.type())) page.complaints.push(message.text());
    });
    page.on('pageerror', (error) => page.complaints.push(error.message));
    page.on('request', (request) => {
        if (!request.url().startsWith('data:')) page.requests.push(request.url());
    });
    await page.goto(pathToFileURL(file).href);
    return page;
}

async function until(holds) {
    const end = Date.now() + patience;
    while (!(await holds())) {
        if (Date.now() > end) throw new Error('waited in vain');
        await new Promise((resolve) => setTimeout(resolve, 10));
    }
}

// Runs tests and ends the process. Each test gets the browser and `file`.
async function run(browser, tests, file) {
    let failed = 0;
    for (const [name, test] of Object.entries(tests)) {
        try {
            await test(browser, file);
            console.log(`ok    ${name}`);
        } catch (error) {
            ++failed;
            console.log(`FAIL  ${name}\n${error.stack}`);
        }
    }
    await browser.close();
    if (failed === 0) fs.rmSync(work, {recursive: true, force: true});
    process.exit(failed === 0 ? 0 : 1);
}

module.exports = {open, patience, program, recipe, run, until, work, write};
