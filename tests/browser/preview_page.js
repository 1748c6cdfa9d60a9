'use strict';
// What a reader does with the pages of `skybake preview`, in a real browser from file://.
//   node preview_page.js PROGRAM FOLDER
const {launched} = require('./chromium.js');
const assert = require('node:assert/strict');
const {execFileSync, spawn} = require('node:child_process');
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
preset = "cumulus_humilis"
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

const data = (page) => page.evaluate(() => JSON.parse(document.getElementById('preview').textContent));
const column = (page, index) => page.$$eval('[aria-label="All assets"] tbody tr',
    (rows, i) => rows.map((row) => row.cells[i].textContent), index);

const tests = {
    async 'asks for nothing and does not complain'(browser, file) {
        const page = await open(browser, file);
        assert.deepEqual(page.complaints, []);
        assert.deepEqual(page.requests, [pathToFileURL(file).href]);
        assert.equal(await page.title(), 'all.toml');
    },

    async 'shows every asset with its figures and its pictures'(browser, file) {
        const page = await open(browser, file);
        const {assets} = await data(page);
        assert.equal(assets.length, 5);
        for (const asset of assets) {
            const text = await page.innerText(`section:has(h2:text-is("${asset.name}"))`);
            assert.ok(text.includes(asset.size.join(' × ')), asset.name);
            assert.ok(text.includes(asset.content), asset.name);
            if (asset.error) assert.match(text, /Lookup error, max \/ RMS\s+\S+ \/ \S+/);
            assert.match(text, /Bake time/);
        }
        const broken = await page.$$eval('img', (images) => images.filter(
            (image) => !image.complete || image.naturalWidth === 0 || image.alt.length < 10).map((image) => image.alt));
        assert.deepEqual(broken, []);
        assert.ok((await page.$$('figure')).length >= 8);
        const names = new Set(fs.readdirSync(path.dirname(file)));
        const shown = await page.$$eval('figure', (figures) => figures.map((figure) => figure.dataset.name));
        for (const name of shown) assert.ok(names.has(`${name}.png`), name);
    },

    async 'shows its pictures without scripts'(browser, file) {
        const page = await open(browser, file, {javaScriptEnabled: false});
        const images = page.locator('img');
        const names = fs.readdirSync(path.dirname(file)).filter((name) => name.endsWith('.png'));
        assert.equal(await images.count(), names.length);
        for (let i = 0; i < names.length; ++i) {
            const box = await images.nth(i).boundingBox();
            assert.ok(box.width > 50 && box.height > 50 && box.x + box.width <= 1280, JSON.stringify(box));
        }
        assert.match(await page.innerText('body'), /Without JavaScript/);
    },

    async 'begins with all clouds in one sky, as wide as the page'(browser, file) {
        const page = await open(browser, file);
        const names = await page.$$eval('figure', (figures) => figures.map((figure) => figure.dataset.name));
        assert.deepEqual(names.slice(0, 2), ['scene_sun_20', 'cumulus_lit_sun_20']);
        const box = await page.locator('figure').first().boundingBox();
        assert.ok(box.width > 1000 && box.y < 200, JSON.stringify(box));
        assert.ok((await page.$$('img.plot')).length >= 5);
        // Of a recipe no file is written: no column for them.
        assert.equal((await page.$$('[aria-label="All assets"] th:text-is("Files")')).length, 0);
    },

    async 'shows one of several pictures of a kind, by tabs'(browser, file) {
        for (const width of [1280, 400]) {
            const page = await open(browser, file, {viewport: {width, height: 800}});
            const tabbed = page.locator('section:has(h2:text-is("transmittance")) .tabbed');
            assert.equal(await tabbed.count(), 1);
            const tabs = tabbed.locator('[role=tab]');
            assert.equal(await tabs.count(), 3);  // channels
            const shown = async () => {
                const states = await tabbed.evaluate((whole) => Array.from(whole.querySelectorAll('[role=tab]'), (tab) => {
                    const panel = document.getElementById(tab.getAttribute('aria-controls'));
                    return [tab.getAttribute('aria-selected') === 'true', panel.getClientRects().length > 0,
                            panel.getAttribute('aria-labelledby') === tab.id, tab.tabIndex === 0];
                }));
                for (const [selected, visible, labelled, focusable] of states) {
                    assert.equal(visible, selected);
                    assert.equal(focusable, selected);
                    assert.ok(labelled);
                }
                assert.equal(states.filter(([selected]) => selected).length, 1);
                return states.findIndex(([selected]) => selected);
            };
            assert.equal(await shown(), 0);
            await tabs.nth(0).focus();
            for (const [key, at] of [['ArrowRight', 1], ['ArrowRight', 2], ['ArrowRight', 0], ['ArrowLeft', 2],
                                     ['Home', 0], ['End', 2]]) {
                await page.keyboard.press(key);
                assert.equal(await shown(), at, key);
                assert.ok(await tabs.nth(at).evaluate((tab) => tab === document.activeElement));
            }
            // Tab goes on to the picture, which Enter enlarges.
            await page.keyboard.press('Tab');
            await page.keyboard.press('Enter');
            assert.ok(await page.locator('dialog').isVisible());
            await page.keyboard.press('Escape');
            await tabs.nth(1).click();
            assert.equal(await shown(), 1);
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= width);
            assert.deepEqual(page.complaints, []);
        }
    },

    async 'has no white plot on a dark page, and says each title once'(browser, file) {
        const page = await open(browser, file, {colorScheme: 'dark'});
        const bright = await page.evaluate(async () => {
            const bright = [];
            for (const image of document.querySelectorAll('figure:not(.scene) img')) {
                await image.decode();
                const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
                const context = canvas.getContext('2d');
                context.drawImage(image, 0, 0);
                const [r, g, b] = context.getImageData(1, 1, 1, 1).data;  // the paper
                const inverted = getComputedStyle(image).filter.includes('invert');
                const grey = (r + g + b) / 3;
                if ((inverted ? 255 - grey : grey) > 80) bright.push(image.dataset.file);
            }
            return bright;
        });
        assert.deepEqual(bright, []);
        const {assets} = await data(page);
        const titled = assets.flatMap((asset) => asset.pictures).filter((picture) => picture.titled);
        assert.ok(titled.length > 10);
        for (const picture of titled) {
            assert.equal(await page.locator(`figure[data-name="${picture.name}"] figcaption b`).count(), 0);
        }
    },

    async 'sorts numbers as numbers'(browser, file) {
        const page = await open(browser, file);
        const {assets} = await data(page);
        const names = (sorted) => sorted.map((asset) => asset.name);
        const voxels = (asset) => asset.size.reduce((product, edge) => product * edge, 1);
        await page.click('[aria-label="All assets"] th button:text-is("Size")');
        assert.deepEqual((await column(page, 0)), names(assets.slice().sort((a, b) => voxels(a) - voxels(b))));
        await page.click('[aria-label="All assets"] th button:text-is("Size")');
        assert.deepEqual((await column(page, 0)), names(assets.slice().sort((a, b) => voxels(b) - voxels(a))));
        assert.equal(await page.getAttribute('[aria-label="All assets"] th:has(button:text-is("Size"))', 'aria-sort'), 'descending');

        // Assets of light that is scattered more than once have a sky error, in percent.
        const withSky = assets.filter((asset) => asset.error && asset.error.sky);
        assert.ok(withSky.length > 0 && withSky.length < assets.length);
        const percents = (await column(page, 4)).filter((text) => /^[\d.e-]+ %$/.test(text));
        assert.equal(percents.length, withSky.length);

        // By keyboard; assets without a figure stay last both ways.
        for (const sign of [1, -1]) {
            await page.focus('[aria-label="All assets"] th button:text-is("Lookup error, max")');
            await page.keyboard.press('Enter');
            const measured = assets.filter((asset) => asset.error)
                .sort((a, b) => sign * (a.error.lookup.max - b.error.lookup.max));
            const others = assets.filter((asset) => !asset.error);
            assert.deepEqual((await column(page, 0)).slice(0, measured.length), names(measured));
            assert.equal((await column(page, 6)).filter((text) => text === '–').length, others.length);
        }
    },

    async 'enlarges a picture and closes it'(browser, file) {
        const page = await open(browser, file);
        const first = page.locator('figure .picture').first();
        await first.click();
        const dialog = page.locator('dialog');
        assert.ok(await dialog.isVisible());
        const source = () => page.getAttribute('dialog .stage img', 'src');
        const before = await source();
        await page.keyboard.press('ArrowRight');
        assert.notEqual(await source(), before);
        await page.keyboard.press('ArrowLeft');
        assert.equal(await source(), before);
        // The focus stays within.
        for (let i = 0; i < 8; ++i) {
            await page.keyboard.press('Tab');
            assert.ok(await page.evaluate(() => document.activeElement === document.body
                || document.querySelector('dialog').contains(document.activeElement)));
        }
        const box = await page.locator('dialog .stage img').boundingBox();
        assert.ok(box.y >= 0 && box.y + box.height <= 900 && box.width <= 1280, JSON.stringify(box));
        const fit = await page.$eval('dialog .stage img', (image) => getComputedStyle(image).objectFit);
        assert.equal(fit, 'contain');  // never out of shape
        await page.keyboard.press('Escape');
        assert.ok(!(await dialog.isVisible()));
        assert.ok(await first.evaluate((button) => button === document.activeElement));
        // By keyboard, and closed by its button.
        await page.keyboard.press('Enter');
        assert.ok(await dialog.isVisible());
        await page.click('dialog [aria-label="Close"]');
        assert.ok(!(await dialog.isVisible()));
        assert.deepEqual(page.complaints, []);
    },

    async 'can be read in light and in dark'(browser, file) {
        const shades = [];
        for (const colorScheme of ['light', 'dark']) {
            const page = await open(browser, file, {colorScheme});
            await page.$$eval('details', (all) => all.forEach((one) => { one.open = true; }));
            const faint = await page.evaluate(() => {
                // WCAG 2: relative luminance and contrast.
                const parse = (text) => (text.match(/[\d.]+/g) || []).map(Number);
                const luminance = ([r, g, b]) => {
                    const [x, y, z] = [r, g, b].map((c) => c / 255)
                        .map((c) => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
                    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
                };
                const behind = (element) => {
                    for (let at = element; at; at = at.parentElement) {
                        const colour = parse(getComputedStyle(at).backgroundColor);
                        if (colour.length === 3 || colour[3] === 1) return colour;
                    }
                    return [255, 255, 255];
                };
                const walker = document.createTreeWalker(document.querySelector('main'), NodeFilter.SHOW_TEXT);
                const faint = [];
                for (let node = walker.nextNode(); node; node = walker.nextNode()) {
                    if (node.textContent.trim() === '') continue;
                    const pair = [luminance(parse(getComputedStyle(node.parentElement).color)),
                                  luminance(behind(node.parentElement))].sort((a, b) => b - a);
                    const contrast = (pair[0] + 0.05) / (pair[1] + 0.05);
                    if (contrast < 4.5) faint.push(`${contrast.toFixed(2)} ${node.textContent.slice(0, 40)}`);
                }
                return faint;
            });
            assert.deepEqual(faint, [], colorScheme);
            shades.push(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
        }
        assert.notEqual(shades[0], shades[1]);
    },

    async 'fits a phone'(browser, file) {
        for (const width of [360, 414, 768]) {
            const page = await open(browser, file, {viewport: {width, height: 740}});
            await page.$$eval('details', (all) => all.forEach((one) => { one.open = true; }));
            assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= width, `${width}`);
            await page.locator('figure .picture').first().click();
            const image = await page.locator('dialog .stage img').boundingBox();
            assert.ok(image.x >= 0 && image.x + image.width <= width, `${width}`);
        }
    },

    async 'turns a turntable by slider, drag, keys and by itself'(browser) {
        const out = path.join(work, 'turning');
        execFileSync(program, ['preview', write('turning.toml', recipe), '--only', 'cumulus', '--turntable', '6',
                               '--size', '64x36', '-o', out, '-q']);
        const page = await open(browser, path.join(out, 'index.html'));
        const figure = page.locator('figure.turntable');
        assert.equal(await figure.count(), 1);
        const image = figure.locator('img');
        const number = async () => Number(/_00(\d)\.png$/.exec(await image.getAttribute('src'))[1]);
        const slider = figure.locator('input[type=range]');
        assert.equal(await number(), 0);
        await slider.fill('4');
        assert.equal(await number(), 4);
        assert.match(await figure.innerText(), /Picture 5 of 6/);
        await slider.focus();
        await page.keyboard.press('ArrowRight');
        assert.equal(await number(), 5);
        // A drag across two thirds of the picture turns by four pictures, past the last one.
        const box = await image.boundingBox();
        await page.mouse.move(box.x + box.width / 6, box.y + box.height / 2);
        await page.mouse.down();
        await page.mouse.move(box.x + box.width * 5 / 6, box.y + box.height / 2, {steps: 8});
        await page.mouse.up();
        assert.equal(await number(), 3);
        await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
        assert.equal(await number(), 3);
        const button = figure.locator('button:text-is("Play")');
        await button.click();
        await until(async () => (await number()) === 1);
        await figure.locator('button:text-is("Stop")').click();
        const stopped = await number();
        await page.waitForTimeout(300);
        assert.equal(await number(), stopped);
        assert.ok(await image.evaluate((shown) => shown.complete && shown.naturalWidth === 64));
        assert.deepEqual(page.complaints, []);
    },

    async 'follows a recipe'(browser) {
        const watched = write('watched.toml', recipe);
        const out = path.join(work, 'watched');
        const child = spawn(program, ['preview', watched, '--watch', '-o', out], {stdio: ['ignore', 'ignore', 'pipe']});
        const ended = new Promise((resolve) => child.on('exit', resolve));
        let said = '';
        child.stderr.on('data', (text) => { said += text; });
        try {
            const file = path.join(out, 'index.html');
            await until(() => fs.existsSync(path.join(out, 'preview_state.js')));
            const page = await open(browser, file);
            const pictures = () => page.$$eval('figure img', (images) => images.map((image) => image.src)).catch(() => []);
            const changed = async (before) => until(async () => {
                const now = await pictures();
                return now.length > 0 && JSON.stringify(now) !== JSON.stringify(before);
            });
            const finished = () => page.waitForSelector('.watch:has-text("full quality, rendered in")');
            await finished();
            await page.evaluate(() => scrollTo(0, 500));

            // An editor that writes a new file and renames it over the old one.
            const good = await pictures();
            const start = Date.now();
            fs.writeFileSync(`${watched}.new`, recipe.replace('seed = 7', 'seed = 8'));
            fs.renameSync(`${watched}.new`, watched);
            await changed(good);
            console.log(`    a change was on screen after ${((Date.now() - start) / 1000).toFixed(2)} s`);
            await finished();
            await until(() => page.evaluate(() => Math.abs(scrollY - 500) < 2));

            // A mistake: the diagnostics come, the pictures stay.
            const better = await pictures();
            fs.writeFileSync(watched, recipe.replace('seed = 7', 'sead = 9'));
            await page.waitForSelector('#diagnostics .diagnostic');
            assert.match(await page.innerText('#diagnostics'), /E0102[^]*sead[^]*did you mean/);
            assert.deepEqual(await pictures(), better);
            assert.match(said, /E0102/);

            fs.writeFileSync(watched, recipe.replace('seed = 7', 'seed = 9'));
            await changed(better);
            await page.waitForSelector('#diagnostics:not(:has(*))', {state: 'attached'});

            // A busy program is ended 0.8 s after the signal, on a loaded machine perhaps before it
            // has told the page.
            await finished();
            child.kill('SIGINT');
            assert.equal(await ended, 130);
            await page.waitForSelector('.watch.ended');
            assert.deepEqual(page.complaints, []);
        } finally {
            child.kill('SIGKILL');
        }
    },
};

async function until(holds) {
    const end = Date.now() + patience;
    // A page that is just being left has nothing to say yet.
    const answer = async () => {
        try {
            return await holds();
        } catch (error) {
            if (!/context was destroyed/.test(String(error))) throw error;
            return false;
        }
    };
    while (!(await answer())) {
        if (Date.now() > end) throw new Error('waited in vain');
        await new Promise((resolve) => setTimeout(resolve, 10));
    }
}

(async () => {
    const out = path.join(work, 'all');
    execFileSync(program, ['preview', write('all.toml', recipe), '-o', out, '-q']);
    const browser = await launched(work, patience, ['--disable-gpu']);
    let failed = 0;
    for (const [name, test] of Object.entries(tests)) {
        try {
            await test(browser, path.join(out, 'index.html'));
            console.log(`ok    ${name}`);
        } catch (error) {
            ++failed;
            console.log(`FAIL  ${name}\n${error.stack}`);
        }
    }
    await browser.close();
    if (failed === 0) fs.rmSync(work, {recursive: true, force: true});
    process.exit(failed === 0 ? 0 : 1);
})();
