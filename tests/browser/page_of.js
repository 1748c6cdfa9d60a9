'use strict';
// A Chromium that draws without a GPU, and a page that has what is in some folders and nothing else in
// the world.
const {launched, software_gl} = require('./chromium.js');
const path = require('node:path');

const patience = 1800000;  // ms; nothing here is a test of time, this ends what hangs
const site = 'https://skybake.test/';  // answered from the disk; WebGPU is for secure pages only

const on_canvas = ['--enable-features=Vulkan', '--use-vulkan=swiftshader'];  // WebGPU draws on a canvas with these

// `folders` are the page's, by name; its complaints are in page.complaints. `more` are further options of the command
// line.
async function browser_with_a_page(work, folders, html, more = ['--disable-gpu']) {
    const browser = await launched(work, patience, [...more, ...software_gl,
        '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader']);
    const page = await browser.newPage();
    page.setDefaultTimeout(patience);
    page.complaints = [];
    page.on('console', (message) => {
        if (message.type() === 'error') page.complaints.push(message.text());
    });
    page.on('pageerror', (error) => page.complaints.push(error.stack));
    await page.route('**/*', (route) => {
        const url = route.request().url();
        if (url === site) return route.fulfill({contentType: 'text/html', body: `<link rel="icon" href="data:,">${html}`});
        const [top, ...rest] = url.slice(site.length).split('/');
        if (!url.startsWith(site) || !folders[top]) return route.abort();
        return route.fulfill({path: path.join(folders[top], ...rest)});
    });
    await page.goto(site);
    return {browser, page};
}

module.exports = {browser_with_a_page, on_canvas, patience, site};
