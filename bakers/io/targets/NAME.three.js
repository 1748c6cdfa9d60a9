// Loads $FILE$ into three.js with the wrapping and the filters that its lookups need: put both files
// beside each other and call `await load(renderer)`.
$if KIND=environment$$if FORMAT=exr$// The texture is an equirectangular map of radiance: `scene.background = scene.environment = texture`.
$if KIND=environment$$if FORMAT=exr$// The sun stands $SUN_PLACE$.
$if KIND=environment$$if FORMAT=ktx2$// The texture is a cube map of radiance: `scene.background = scene.environment = texture`. Straight ahead
$if KIND=environment$$if FORMAT=ktx2$// is +z and right is -x. A samplerCube of your own is read at (right, up, ahead).
$if PARTS=none$$if FORMAT=ktx2$// `skybake info --lookup $FILE$` prints the GLSL that reads the texture.
$if PLAYS=yes$// It plays: frame n, counted from 1 to `frames`, is `await load(renderer, n)`, and there are `rate` of them a second.
$if LAMP=yes$// The map lacks the sun's disc, so add `sunlight()` to the scene as well.
import * as THREE from 'three';
$if PARTS=none$$if FORMAT=ktx2$import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
$if PARTS=cube$$if FORMAT=ktx2$import { read } from 'three/addons/libs/ktx-parse.module.js';
$if PARTS=cube$$if FORMAT=ktx2$import { ZSTDDecoder } from 'three/addons/libs/zstddec.module.js';
$if FORMAT=exr$import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';

$if PLAYS=yes$export const frames = $FRAMES$;
$if PLAYS=yes$export const rate = $RATE$;
$if PLAYS=yes$const file = (frame) => `./$NAME$_${String(frame).padStart($DIGITS$, '0')}$ENDING$`;
$if PLAYS=yes$
$if PARTS=none$const wraps = { repeat: THREE.RepeatWrapping, clamp: THREE.ClampToEdgeWrapping };
$if PARTS=none$
$if PARTS=cube$// KTX2Loader of three.js 0.180 makes no cubes of numbers. Returns the cube of one level.
$if PARTS=cube$function cube_of(bytes, edge) {
$if PARTS=cube$$if TYPE=half$    const texels = new Uint16Array(bytes.buffer), type = THREE.HalfFloatType;
$if PARTS=cube$$if TYPE=float$    const texels = new Float32Array(bytes.buffer), type = THREE.FloatType;
$if PARTS=cube$    const channels = texels.length / (6 * edge * edge);
$if PARTS=cube$    const format = channels === 1 ? THREE.RedFormat : THREE.RGBAFormat;
$if PARTS=cube$    const count = edge * edge * channels;
$if PARTS=cube$    const face = (i) => new THREE.DataTexture(texels.subarray(i * count, (i + 1) * count), edge, edge, format, type);
$if PARTS=cube$    const texture = new THREE.CubeTexture([0, 1, 2, 3, 4, 5].map(face));
$if PARTS=cube$    texture.format = format;
$if PARTS=cube$    texture.type = type;
$if PARTS=cube$    return texture;
$if PARTS=cube$}
$if PARTS=cube$
$if PARTS=none$// Returns a $WIDTH$ x $HEIGHT$ x $DEPTH$ texture of type $TYPE$.
$if PARTS=cube$// Returns a cube texture of type $TYPE$ with faces of $WIDTH$ x $WIDTH$ texels.
$if PLAYS=no$$if PARTS=none$$if FORMAT=ktx2$export async function load(renderer) {
$if PLAYS=yes$$if PARTS=none$$if FORMAT=ktx2$export async function load(renderer, frame = 1) {
$if PARTS=none$$if FORMAT=ktx2$    const loader = new KTX2Loader().detectSupport(renderer);
$if PARTS=cube$$if FORMAT=ktx2$export async function load() {
$if FORMAT=exr$export async function load() {
$if FORMAT=exr$    const loader = new EXRLoader().setDataType(THREE.HalfFloatType);
$if PLAYS=no$$if PARTS=none$    const texture = await loader.loadAsync(new URL('./$FILE$', import.meta.url).href);
$if PLAYS=yes$$if PARTS=none$    const texture = await loader.loadAsync(new URL(file(frame), import.meta.url).href);
$if PARTS=none$$if FORMAT=ktx2$    loader.dispose();
$if PARTS=cube$    const response = await fetch(new URL('./$FILE$', import.meta.url));
$if PARTS=cube$    if (!response.ok) throw new Error(`$FILE$: ${response.status}`);
$if PARTS=cube$    const container = read(new Uint8Array(await response.arrayBuffer()));
$if PARTS=cube$    const zstd = new ZSTDDecoder();
$if PARTS=cube$    await zstd.init();
$if PARTS=cube$    const cubes = container.levels.map(({ levelData, uncompressedByteLength }, level) => {
$if PARTS=cube$        const is_bare = container.supercompressionScheme === 0;
$if PARTS=cube$        const bytes = is_bare ? levelData.slice() : zstd.decode(levelData, uncompressedByteLength).slice();
$if PARTS=cube$        return cube_of(bytes, $WIDTH$ >> level);
$if PARTS=cube$    });
$if PARTS=cube$    const texture = cubes[0];
$if PARTS=cube$    texture.mipmaps = cubes.slice(1);
$if KIND=environment$$if FORMAT=exr$    texture.mapping = THREE.EquirectangularReflectionMapping;
    texture.colorSpace = THREE.NoColorSpace;
$if PARTS=none$    texture.wrapS = wraps.$WRAP_U$;
$if PARTS=none$    texture.wrapT = wraps.$WRAP_V$;
$if DIM=3$    texture.wrapR = wraps.$WRAP_W$;
$if FILTER=linear$    texture.magFilter = texture.minFilter = THREE.LinearFilter;
$if FILTER=nearest$    texture.magFilter = texture.minFilter = THREE.NearestFilter;
$if PARTS=none$    if (texture.mipmaps.length > 1) texture.minFilter = THREE.LinearMipmapLinearFilter;
$if PARTS=cube$    if (texture.mipmaps.length > 0) texture.minFilter = THREE.LinearMipmapLinearFilter;
    texture.generateMipmaps = false;
    texture.needsUpdate = true;
    return texture;
}
$if LAMP=yes$
$if LAMP=yes$// The sun. Its intensity is the irradiance of a surface that faces it, in the unit of the map.
$if LAMP=yes$export function sunlight() {
$if LAMP=yes$    const light = new THREE.DirectionalLight(new THREE.Color($SUN_R$, $SUN_G$, $SUN_B$), $IRRADIANCE$);
$if LAMP=yes$$if PARTS=none$    light.position.set($SUN_AHEAD$, $SUN_UP$, $SUN_RIGHT$);
$if LAMP=yes$$if PARTS=cube$    light.position.set(-($SUN_RIGHT$), $SUN_UP$, $SUN_AHEAD$);
$if LAMP=yes$    return light;
$if LAMP=yes$}
