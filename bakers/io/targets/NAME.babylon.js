// Makes a texture of Babylon.js of the texels in $FILE$, with the wrapping and the filter that its
// lookups need: put both files beside each other and call `await load(BABYLON, scene)`.
// `skybake info --lookup $FILE$` prints the GLSL that reads the texture, and --language wgsl the WGSL.
const size = [$WIDTH$, $HEIGHT$, $DEPTH$];
const channels = $CHANNELS$;
const type = '$TYPE$';

// GPUs have no textures of three channels: a fourth is added, which is 1.
function padded(texels) {
    if (channels !== 3) return texels;
    const one = { float: 1, half: 0x3c00, unorm8: 255 }[type];
    const wide = new texels.constructor(texels.length / 3 * 4).fill(one);
    for (let i = 0, o = 0; i < texels.length; i += 3, o += 4) wide.set(texels.subarray(i, i + 3), o);
    return wide;
}

// Returns a texture of $WIDTH$ x $HEIGHT$ x $DEPTH$ texels.
export async function load(BABYLON, scene) {
    const response = await fetch(new URL('./$FILE$', import.meta.url));
    if (!response.ok) throw new Error(`$FILE$: ${response.status}`);
    const Texels = { float: Float32Array, half: Uint16Array, unorm8: Uint8Array }[type];
    const texels = padded(new Texels(await response.arrayBuffer()));
    const { Constants, Texture } = BABYLON;
    const format = [0, Constants.TEXTUREFORMAT_R, Constants.TEXTUREFORMAT_RG, Constants.TEXTUREFORMAT_RGBA,
                    Constants.TEXTUREFORMAT_RGBA][channels];
    const number = { float: Constants.TEXTURETYPE_FLOAT, half: Constants.TEXTURETYPE_HALF_FLOAT,
                     unorm8: Constants.TEXTURETYPE_UNSIGNED_BYTE }[type];
$if FILTER=linear$    const sampling = Texture.BILINEAR_SAMPLINGMODE;
$if FILTER=nearest$    const sampling = Texture.NEAREST_SAMPLINGMODE;
$if DIM=2$    const texture = new BABYLON.RawTexture(texels, size[0], size[1], format, scene, false, false, sampling, number);
$if DIM=3$    const texture = new BABYLON.RawTexture3D(texels, ...size, format, scene, false, false, sampling, number);
    const wraps = { repeat: Texture.WRAP_ADDRESSMODE, clamp: Texture.CLAMP_ADDRESSMODE };
    texture.wrapU = wraps.$WRAP_U$;
    texture.wrapV = wraps.$WRAP_V$;
$if DIM=3$    texture.wrapR = wraps.$WRAP_W$;
    texture.gammaSpace = false;
    texture.anisotropicFilteringLevel = 1;  // lookups that jump between pixels would be blurred
    return texture;
}
