'use strict';
// Uses the pages of `skybake preview` as a reader does, in a real browser from file://.
//   node preview_page.js PROGRAM FOLDER
const {launched} = require('./chromium.js');
const {open, patience, program, recipe, run, work, write} = require('./preview_tools.js');
const assert = require('node:assert/strict');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {pathToFileURL} = require('node:url');

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
        assert.deepEqual(names.slice(0, 2), ['scene_sun_40', 'scene_sun_5']);
        const box = await page.locator('figure').first().boundingBox();
        assert.ok(box.width > 1000 && box.y < 200, JSON.stringify(box));
        assert.ok((await page.$$('img.plot')).length >= 5);
        // A preview of a recipe writes no file: there is no column for them.
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

    async 'draws charts with letters of one size'(browser, file) {
        const page = await open(browser, file);
        const images = await page.$$eval('figure:not(.scene):not(.turntable) img', (images) => images.map(
            (image) => [image.dataset.file, image.naturalWidth, image.getBoundingClientRect().width]));
        const room = await page.evaluate(() => document.querySelector('.gallery').clientWidth - 2);
        const shown = images.filter(([, , width]) => width > 0);  // not behind a tab
        assert.ok(shown.length >= 8);
        for (const [name, natural, width] of shown) {
            if (natural >= 250) assert.equal(width, Math.min(natural, room), name);
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

        // Sorts by keyboard; assets without a figure stay last both ways.
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
        // Opens it by keyboard, and closes it by its button.
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

};

(async () => {
    const out = path.join(work, 'all');
    execFileSync(program, ['preview', write('all.toml', recipe), '-o', out, '-q'], {stdio: 'pipe'});
    await run(await launched(work, patience, ['--disable-gpu']), tests, path.join(out, 'index.html'));
})();
