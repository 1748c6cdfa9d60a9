// Makes a texture of Babylon.js of the texels in $FILE$, with the wrapping and the filter that its
// lookups need: put both files beside each other and call `await load(BABYLON, scene)`.
$if PARTS=cube$// Straight ahead is +z, up +y and right +x, as in Babylon.js: use the texture as the reflection of a material, with
$if PARTS=cube$// coordinatesMode CUBIC_MODE, or SKYBOX_MODE on a box around the camera.
$if KIND=environment$$if MAPPING=longitude_latitude$// It is a panorama, straight ahead +x and up +y, for the reflection of a material, also of a sphere around the
$if KIND=environment$$if MAPPING=longitude_latitude$// camera. The sun stands $SUN_PLACE$.
$if PARTS=none$// `skybake info --lookup $FILE$` prints the GLSL that reads the texture, and --language wgsl the WGSL.
$if PLAYS=yes$// It plays: frame n, counted from 1 to `frames`, is `await load(BABYLON, scene, n)`, and there are `rate` a second.
$if LAMP=yes$// The map lacks the sun's disc, so call `sunlight(BABYLON, scene)` as well.
const size = [$WIDTH$, $HEIGHT$, $DEPTH$];
const channels = $CHANNELS$;
const type = '$TYPE$';

$if PLAYS=yes$export const frames = $FRAMES$;
$if PLAYS=yes$export const rate = $RATE$;
$if PLAYS=yes$const file = (frame) => `./$NAME$_${String(frame).padStart($DIGITS$, '0')}$ENDING$`;
$if PLAYS=yes$
// GPUs have no textures of three channels: a fourth is added, which is 1.
function padded(texels) {
    if (channels !== 3) return texels;
    const one = { float: 1, half: 0x3c00, unorm8: 255 }[type];
    const wide = new texels.constructor(texels.length / 3 * 4).fill(one);
    for (let i = 0, o = 0; i < texels.length; i += 3, o += 4) wide.set(texels.subarray(i, i + 3), o);
    return wide;
}

$if PARTS=none$// Returns a texture of $WIDTH$ x $HEIGHT$ x $DEPTH$ texels.
$if PARTS=cube$// Returns a cube texture with faces of $WIDTH$ x $WIDTH$ texels.
$if PLAYS=no$export async function load(BABYLON, scene) {
$if PLAYS=yes$export async function load(BABYLON, scene, frame = 1) {
$if PLAYS=no$    const url = new URL('./$FILE$', import.meta.url);
$if PLAYS=yes$    const url = new URL(file(frame), import.meta.url);
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status}`);
    const Texels = { float: Float32Array, half: Uint16Array, unorm8: Uint8Array }[type];
    const texels = padded(new Texels(await response.arrayBuffer()));
    const { Constants, Texture } = BABYLON;
    const format = [0, Constants.TEXTUREFORMAT_R, Constants.TEXTUREFORMAT_RG, Constants.TEXTUREFORMAT_RGBA,
                    Constants.TEXTUREFORMAT_RGBA][channels];
    const number = { float: Constants.TEXTURETYPE_FLOAT, half: Constants.TEXTURETYPE_HALF_FLOAT,
                     unorm8: Constants.TEXTURETYPE_UNSIGNED_BYTE }[type];
$if FILTER=linear$    const sampling = Texture.BILINEAR_SAMPLINGMODE;
$if FILTER=nearest$    const sampling = Texture.NEAREST_SAMPLINGMODE;
$if PARTS=cube$    const count = texels.length / 6;
$if PARTS=cube$    const faces = [0, 1, 2, 3, 4, 5].map((i) => texels.slice(i * count, (i + 1) * count));
$if PARTS=cube$    const texture = new BABYLON.RawCubeTexture(scene, faces, size[0], format, number, false, false, sampling);
$if PARTS=none$$if DIM=2$    const texture = new BABYLON.RawTexture(texels, size[0], size[1], format, scene, false, false, sampling, number);
$if DIM=3$    const texture = new BABYLON.RawTexture3D(texels, ...size, format, scene, false, false, sampling, number);
$if PARTS=none$    const wraps = { repeat: Texture.WRAP_ADDRESSMODE, clamp: Texture.CLAMP_ADDRESSMODE };
$if PARTS=none$    texture.wrapU = wraps.$WRAP_U$;
$if PARTS=none$    texture.wrapV = wraps.$WRAP_V$;
$if DIM=3$    texture.wrapR = wraps.$WRAP_W$;
$if KIND=environment$$if MAPPING=longitude_latitude$    texture.coordinatesMode = scene.useRightHandedSystem ? Texture.FIXED_EQUIRECTANGULAR_MODE
$if KIND=environment$$if MAPPING=longitude_latitude$                                                         : Texture.FIXED_EQUIRECTANGULAR_MIRRORED_MODE;
    texture.gammaSpace = false;
    texture.anisotropicFilteringLevel = 1;  // lookups that jump between pixels would be blurred
    return texture;
}
$if LAMP=yes$
$if LAMP=yes$// The sun. Its intensity is the irradiance of a surface that faces it, in the unit of the map.
$if LAMP=yes$export function sunlight(BABYLON, scene) {
$if LAMP=yes$$if PARTS=cube$    const toSun = new BABYLON.Vector3($SUN_RIGHT$, $SUN_UP$, $SUN_AHEAD$);
$if LAMP=yes$$if PARTS=none$    const left = scene.useRightHandedSystem ? -1 : 1;  // where +z points, seen ahead
$if LAMP=yes$$if PARTS=none$    const toSun = new BABYLON.Vector3($SUN_AHEAD$, $SUN_UP$, -left * ($SUN_RIGHT$));
$if LAMP=yes$    const light = new BABYLON.DirectionalLight('$NAME$', toSun.scale(-1), scene);
$if LAMP=yes$    light.diffuse = light.specular = new BABYLON.Color3($SUN_R$, $SUN_G$, $SUN_B$);
$if LAMP=yes$    light.intensity = $IRRADIANCE$;
$if LAMP=yes$    return light;
$if LAMP=yes$}
