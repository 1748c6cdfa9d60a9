'use strict';
// A Chromium that keeps its settings in a folder and asks the world for nothing.
const {chromium} = require('playwright-core');
const path = require('node:path');

// `patience` is in ms, `more` are further options of the command line.
function launched(work, patience, more) {
    const profile = path.join(work, 'profile');
    return chromium.launch({
        executablePath: '/usr/bin/chromium',
        timeout: patience,
        env: {...process.env, HOME: work, XDG_CONFIG_HOME: profile, XDG_CACHE_HOME: profile},
        args: ['--no-sandbox', ...more, '--disable-quic', '--no-first-run',
               '--disable-background-networking', '--disable-component-update', '--disable-sync'],
    });
}

// Draws with WebGL on the processor.
const software_gl = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

module.exports = {launched, software_gl};
