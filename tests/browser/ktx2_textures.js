// three.js' KTX2Loader, and the ktx-parse and zstddec inside of it, read KTX2 files: every level has
// the texels that stand bare in the files beside it, and the key of the description has it. No page
// is shown: what the loader hands to WebGL is compared.
'use strict';
const { execFileSync } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

const program = process.argv[2];
// Modules are found beside the importing file alone, whatever NODE_PATH says.
const packages = path.join(process.argv[3], 'node_modules');
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'skybake-ktx2-'));
let checks = 0;
let failures = 0;
function expect(found, wanted, what) {
    ++checks;
    if (found === wanted) return;
    ++failures;
    console.log(`${what} is ${found}, not ${wanted}`);
}

const bytesPerNumber = { float: 4, half: 2, unorm8: 1, unorm16: 2 };

// Texels of three channels have a fourth, which is 1.
function padded(bare, channels, type) {
    if (channels !== 3) return bare;
    const size = bytesPerNumber[type];
    const one = { float: [0, 0, 0x80, 0x3f], half: [0, 0x3c], unorm8: [255], unorm16: [255, 255] }[type];
    const out = Buffer.alloc(bare.length / 3 * 4);
    for (let i = 0, o = 0; i < bare.length; i += 3 * size, o += 4 * size) {
        bare.copy(out, o, i, i + 3 * size);
        Buffer.from(one).copy(out, o + 3 * size);
    }
    return out;
}

// The levels of a texture of three.js, as bytes.
function levels(texture) {
    const images = texture.mipmaps && texture.mipmaps.length > 0 ? texture.mipmaps : [texture.image];
    return images.map((image) => Buffer.from(image.data.buffer, image.data.byteOffset, image.data.byteLength));
}

async function main() {
    const recipe = path.join(__dirname, '../consumers/containers.toml');
    execFileSync(program, ['bake', recipe, '--output', folder, '--quiet']);
    const THREE = await import(`${packages}/three/build/three.module.js`);
    const { KTX2Loader } = await import(`${packages}/three/examples/jsm/loaders/KTX2Loader.js`);
    const { read } = await import(`${packages}/three/examples/jsm/libs/ktx-parse.module.js`);
    const loader = new KTX2Loader();
    loader.workerConfig = { bptcSupported: true };
    const manifest = JSON.parse(fs.readFileSync(path.join(folder, 'manifest.json')));
    const types = new Set();
    for (const asset of manifest.assets) {
        const file = asset.files.find((f) => f.format === 'ktx2');
        if (!file) continue;
        const bytes = fs.readFileSync(path.join(folder, file.path));
        const container = read(new Uint8Array(bytes));
        expect(container.levelCount, asset.mips.length + 1, `${file.path}: levels`);
        expect(container.pixelDepth, asset.size[2], `${file.path}: depth`);
        expect(String(container.keyValue.KTXorientation), 'rdi', `${file.path}: orientation`);
        const said = JSON.parse(Buffer.from(container.keyValue['skybake/asset']).toString().replace(/\0$/, ''));
        expect(said.content_hash, asset.content_hash, `${file.path}: content hash`);
        types.add(file.pixel_type);
        const isBlocks = !(file.pixel_type in bytesPerNumber);
        if (isBlocks) {  // three makes no 3-D textures of blocks
            const dfd = container.dataFormatDescriptor[0];
            expect(dfd.colorModel, file.pixel_type === 'bc4' ? 131 : 133, `${file.path}: model`);
            expect(dfd.bytesPlane[0], file.pixel_type === 'bc4' ? 8 : 16, `${file.path}: bytes`);
            continue;
        }
        if (file.pixel_type === 'unorm16') continue;  // nor any of 16-bit integers
        const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
        const texture = await loader._createTexture(buffer);
        expect(texture.isData3DTexture, true, `${file.path}: whether it is a 3-D texture`);
        expect(texture.colorSpace, THREE.NoColorSpace, `${file.path}: colour space`);
        const found = levels(texture);
        expect(found.length >= 1, true, `${file.path}: whether it has levels`);
        found.forEach((texels, level) => {
            const bare = asset.files.find((f) => f.format === 'bin' && f.level === level);
            const wanted = padded(fs.readFileSync(path.join(folder, bare.path)), asset.channels.length, file.pixel_type);
            expect(Buffer.compare(texels, wanted), 0, `${file.path}: difference of level ${level}`);
        });
    }
    expect([...types].sort().join(), 'bc4,bc6h,float,half,unorm16,unorm8', 'the list of types');
    console.log(failures > 0 ? `${failures} of ${checks} checks failed` : `${checks} checks`);
    fs.rmSync(folder, { recursive: true, force: true });
    process.exit(failures > 0 ? 1 : 0);
}

main();
