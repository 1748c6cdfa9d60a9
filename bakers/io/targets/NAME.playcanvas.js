// Loads $FILE$ into PlayCanvas as the skybox: put both files beside each other and call
// `app.scene.skybox = await load(pc, app)`. Straight ahead is +z, up +y and right -x, in the unit of the map.
$if LAMP=yes$// The map lacks the sun's disc, so call `app.root.addChild(sunlight(pc))` as well.

// Returns a cube texture. PlayCanvas takes colours as they are where a camera has GAMMA_NONE and TONEMAP_NONE.
export async function load(pc, app) {
    const asset = new pc.Asset('$NAME$', 'texture', { url: new URL('./$FILE$', import.meta.url).href });
    app.assets.add(asset);
    const texture = await new Promise((resolve, reject) => {
        asset.once('load', () => resolve(asset.resource));
        asset.once('error', (message) => reject(new Error(message)));
        app.assets.load(asset);
    });
$if PARTS=cube$    return texture;
$if PARTS=none$    return pc.EnvLighting.generateSkyboxCubemap(texture);
}
$if LAMP=yes$
$if LAMP=yes$// The sun. PlayCanvas takes colours of lights to the power of 2.2, and reflects them without the division by pi.
$if LAMP=yes$export function sunlight(pc) {
$if LAMP=yes$    const channel = (share) => ($ENERGY$ * share) ** (1 / 2.2);
$if LAMP=yes$    const sun = new pc.Entity('$NAME$');
$if LAMP=yes$    sun.addComponent('light', { type: 'directional', intensity: 1,
$if LAMP=yes$                                color: new pc.Color(channel($SUN_R$), channel($SUN_G$), channel($SUN_B$)) });
$if LAMP=yes$    const toSun = new pc.Vec3(-($SUN_RIGHT$), $SUN_UP$, $SUN_AHEAD$);
$if LAMP=yes$    sun.setRotation(new pc.Quat().setFromDirections(pc.Vec3.UP, toSun));  // it shines along its -y
$if LAMP=yes$    return sun;
$if LAMP=yes$}
