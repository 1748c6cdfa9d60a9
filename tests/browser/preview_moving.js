'use strict';
// Tests the moving parts of pages of `skybake preview`: turntables, and the pictures of a recipe that is watched.
//   node preview_moving.js PROGRAM FOLDER
const {launched} = require('./chromium.js');
const {open, patience, program, recipe, run, until, work, write} = require('./preview_tools.js');
const assert = require('node:assert/strict');
const {execFileSync, spawn} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const sequence = `
[noise.full.channels.Y]
type = "constant"
value = 1
[clouds.cumulus]
noise = "full"
extent = ["1 km", "1 km", "500 m"]
base_altitude = "500 m"
height_profile = { type = "tabulated", table = [[0, 0]] }
threshold = 0.1
period = 4
drift = [1, 0]
[[clouds.cumulus.towers]]
center = [0.4, 0.6]
sigma = [0.15, 0.15]
amplitude = 1
[bake.cumulus]
asset = "cloud_volume"
cloud = "cumulus"
size = [32, 32, 16]
frames = 4
frames_per_second = 5
formats = ["vdb", "usda"]
`;

const tests = {
    async 'turns a turntable by slider, drag, keys and by itself'(browser) {
        const out = path.join(work, 'turning');
        execFileSync(program, ['preview', write('turning.toml', recipe), '--only', 'cumulus', '--turntable', '6',
                               '--sun-elevation', '40',
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

    async 'plays the lit frames of a sequence'(browser) {
        const out = path.join(work, 'sequence');
        execFileSync(program, ['preview', write('sequence.toml', sequence), '--size', '64x36', '--sun-elevation', '40,8',
                               '-o', out, '-q']);
        const file = path.join(out, 'index.html');
        const number = async (figure) => Number(/_000(\d)\.png$/.exec(await figure.locator('img').getAttribute('src'))[1]);
        // Whoever asks for less motion sees the first frame until Play is pressed.
        const still = await open(browser, file, {reducedMotion: 'reduce'});
        const resting = still.locator('figure.turntable').first();
        assert.equal(await resting.locator('button').innerText(), 'Play');
        await still.waitForTimeout(400);
        assert.equal(await number(resting), 1);
        await resting.locator('button').focus();
        await still.keyboard.press('Enter');
        await until(async () => (await number(resting)) === 3);
        await still.keyboard.press('Space');
        const stopped = await number(resting);
        await still.waitForTimeout(400);
        assert.equal(await number(resting), stopped);
        await resting.locator('input[type=range]').focus();
        await still.keyboard.press('Home');
        await still.keyboard.press('ArrowRight');
        assert.equal(await number(resting), 2);
        assert.match(await resting.innerText(), /Frame 2 of 4\./);
        assert.deepEqual(still.complaints, []);
        // For all others it plays, and begins anew after the last frame.
        const page = await open(browser, file, {reducedMotion: 'no-preference'});
        const figures = page.locator('figure.turntable');
        assert.equal(await figures.count(), 2, 'one for each sun');
        const playing = figures.first();
        assert.equal(await playing.locator('button').innerText(), 'Stop');
        for (const frame of [3, 4, 1]) await until(async () => (await number(playing)) === frame);
        const image = playing.locator('img');
        assert.ok(await image.evaluate((shown) => shown.complete && shown.naturalWidth === 64));
        assert.match(await page.locator('section:has(figure.turntable) .lead').innerText(), /4 frames of cumulus, which play at 5 per second/);
        // A key on the slider stops it.
        await playing.locator('input[type=range]').focus();
        await page.keyboard.press('Home');
        assert.equal(await playing.locator('button').innerText(), 'Play');
        await page.waitForTimeout(400);
        assert.equal(await number(playing), 1);
        // The frames differ, and lie in the section of the sequence alone.
        const bytes = [1, 2, 3, 4].map((n) => fs.readFileSync(path.join(out, `cumulus_frames_sun_40_000${n}.png`)));
        assert.equal(new Set(bytes.map((one) => one.toString('base64'))).size, 4);
        assert.equal(await page.locator('section:has(h2:text-is("cumulus_0001")) figure.scene').count(), 0);
        assert.deepEqual(page.complaints, []);
    },

    async 'follows a recipe'(browser) {
        const watched = write('watched.toml', recipe);
        const out = path.join(work, 'watched');
        const child = spawn(program, ['preview', watched, '--watch', '--size', '160x90', '-o', out], {stdio: ['ignore', 'ignore', 'pipe']});
        const ended = new Promise((resolve) => child.on('exit', resolve));
        let said = '';
        child.stderr.on('data', (text) => { said += text; });
        try {
            const file = path.join(out, 'index.html');
            await until(() => fs.existsSync(path.join(out, 'preview_state.js')));
            const page = await open(browser, file);
            const pictures = () => page.$$eval('figure img', (images) => images.map((image) => image.src));
            const changed = async (before) => until(async () => {
                const now = await pictures();
                return now.length > 0 && JSON.stringify(now) !== JSON.stringify(before);
            });
            const finished = () => page.waitForSelector('.watch:has-text("full quality, rendered in")');
            await finished();
            // The page keeps a reader's choices, and is never loaded again itself.
            const first = page.locator('section:has(h2:text-is("transmittance"))');
            await first.locator('[role=tab]').nth(1).click();
            await first.locator('summary').last().focus();
            await page.keyboard.press('Enter');
            await page.evaluate(() => { window.same = true; });
            await page.evaluate(() => scrollTo(0, 500));
            const kept = async () => {
                assert.equal(await page.evaluate(() => window.same), true);
                assert.equal(await first.locator('[role=tab]').nth(1).getAttribute('aria-selected'), 'true');
                assert.ok(await first.locator('details').last().evaluate((part) => part.open && part.contains(document.activeElement)));
                assert.ok(await page.evaluate(() => Math.abs(scrollY - 500) < 2));
            };

            // An editor that writes a new file and renames it over the old one.
            const good = await pictures();
            const start = Date.now();
            fs.writeFileSync(`${watched}.new`, recipe.replace('seed = 7', 'seed = 8'));
            fs.renameSync(`${watched}.new`, watched);
            await changed(good);
            console.log(`    a change was on screen after ${((Date.now() - start) / 1000).toFixed(2)} s`);
            await kept();
            await finished();
            await kept();

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

    async 'keeps an enlarged picture open while it is made anew'(browser) {
        const watched = write('enlarged.toml', recipe), out = path.join(work, 'enlarged');
        const child = spawn(program, ['preview', watched, '--watch', '-o', out, '--only', 'shape'], {stdio: 'ignore'});
        try {
            await until(() => fs.existsSync(path.join(out, 'preview_state.js')));
            const page = await open(browser, path.join(out, 'index.html'));
            await page.waitForSelector('.watch:has-text("full quality, rendered in")');
            await page.locator('figure .picture').first().click();
            const shown = () => page.getAttribute('dialog .stage img', 'src');
            const before = await shown();
            fs.writeFileSync(watched, recipe.replace('seed = 7', 'seed = 8'));
            await until(async () => (await shown()) !== before);
            assert.ok(await page.locator('dialog').isVisible());
            assert.deepEqual(page.complaints, []);
        } finally {
            child.kill('SIGKILL');
        }
    },
};

(async () => run(await launched(work, patience, ['--disable-gpu']), tests))();
