$if PARTS=none$// Makes $NAME$.asset, a texture of $WIDTH$ x $HEIGHT$ x $DEPTH$ texels, of $FILE$ whenever that file changes: copy
$if PARTS=cube$// Makes $NAME$.asset, a Cubemap with faces of $WIDTH$ x $WIDTH$ texels, of $FILE$ whenever that file changes: copy
// all files of this name into one folder of Assets, and use $NAME$.asset.
$if PLAYS=yes$// It plays: each of the $FRAMES$ files of $NAME$ has its own .asset, and $RATE$ of them follow each other in a second.
$if IS_SKY=yes$// It makes $NAME$.mat as well, a skybox: straight ahead is +z, up +y and right +x. The menu Tools > Skybake >
$if IS_SKY=yes$// Light with $NAME$ gives it to the scene.
$if LAMP=yes$// The sky lacks the sun's disc, so the menu also adds the sun, as the Built-in and the Universal pipeline count
$if LAMP=yes$// light. HDRP counts in lux and wants pi times as much.
$if IS_SKY=yes$$if PARTS=none$// Row 0 of the texture is straight down and the zenith at v = 1, as Skybox/Panoramic reads it.
$if IS_SKY=no$// Texel (0, 0, 0) is at the lowest coordinates, as in the lookup that
$if IS_SKY=no$// `skybake info --lookup $FILE$ --language hlsl` prints.
#if UNITY_EDITOR
using System.IO;
using UnityEditor;
using UnityEngine;

public class Skybake_$ID$ : AssetPostprocessor {
    const int channels = $CHANNELS$;
$if TYPE=float$    const int bytes = 4;
$if TYPE=half$    const int bytes = 2;
$if TYPE=unorm8$    const int bytes = 1;
$if TYPE=float$    const TextureFormat one = TextureFormat.RFloat, two = TextureFormat.RGFloat, four = TextureFormat.RGBAFloat;
$if TYPE=half$    const TextureFormat one = TextureFormat.RHalf, two = TextureFormat.RGHalf, four = TextureFormat.RGBAHalf;
$if TYPE=unorm8$    const TextureFormat one = TextureFormat.R8, two = TextureFormat.RG16, four = TextureFormat.RGBA32;
$if TYPE=float$    static readonly byte[] full = { 0, 0, 0x80, 0x3f };
$if TYPE=half$    static readonly byte[] full = { 0, 0x3c };
$if TYPE=unorm8$    static readonly byte[] full = { 0xff };

    static bool IsOurs(string path) {
$if PLAYS=no$        return Path.GetFileName(path) == "$FILE$";
$if PLAYS=yes$        return System.Text.RegularExpressions.Regex.IsMatch(Path.GetFileName(path), @"^$NAME$_\d{$DIGITS$}\.bin$");
    }

    static void OnPostprocessAllAssets(string[] imported, string[] deleted, string[] moved, string[] from) {
        foreach (string path in imported) {
            if (IsOurs(path)) Make(path);
        }
    }

    // The file may have been imported before this script was compiled.
    [InitializeOnLoadMethod]
    static void MakeMissing() {
        foreach (string id in AssetDatabase.FindAssets("$NAME$")) {
            string path = AssetDatabase.GUIDToAssetPath(id);
            bool isMissing = !File.Exists(Path.ChangeExtension(path, "asset"));
            if (IsOurs(path) && isMissing) EditorApplication.delayCall += () => Make(path);
        }
    }

    // GPUs have no textures of three channels: a fourth is added, which is 1.
    static byte[] Padded(byte[] texels) {
        if (channels != 3) return texels;
        int count = texels.Length / (3 * bytes);
        var wide = new byte[count * 4 * bytes];
        for (int i = 0; i < count; ++i) {
            System.Buffer.BlockCopy(texels, i * 3 * bytes, wide, i * 4 * bytes, 3 * bytes);
            System.Buffer.BlockCopy(full, 0, wide, (i * 4 + 3) * bytes, bytes);
        }
        return wide;
    }

$if IS_SKY=yes$$if PARTS=none$    static byte[] Flipped(byte[] texels) {
$if IS_SKY=yes$$if PARTS=none$        int row = texels.Length / $HEIGHT$;
$if IS_SKY=yes$$if PARTS=none$        var flipped = new byte[texels.Length];
$if IS_SKY=yes$$if PARTS=none$        for (int y = 0; y < $HEIGHT$; ++y) {
$if IS_SKY=yes$$if PARTS=none$            System.Buffer.BlockCopy(texels, y * row, flipped, ($HEIGHT$ - 1 - y) * row, row);
$if IS_SKY=yes$$if PARTS=none$        }
$if IS_SKY=yes$$if PARTS=none$        return flipped;
$if IS_SKY=yes$$if PARTS=none$    }
$if IS_SKY=yes$$if PARTS=none$
    static void Make(string path) {
        TextureFormat format = channels == 1 ? one : channels == 2 ? two : four;
$if PARTS=cube$        var texture = new Cubemap($WIDTH$, format, false);
$if PARTS=none$$if DIM=2$        var texture = new Texture2D($WIDTH$, $HEIGHT$, format, false, true);
$if DIM=3$        var texture = new Texture3D($WIDTH$, $HEIGHT$, $DEPTH$, format, false);
        byte[] texels = Padded(File.ReadAllBytes(path));
$if IS_SKY=yes$$if PARTS=none$        texels = Flipped(texels);
$if PARTS=none$        texture.SetPixelData(texels, 0);
$if PARTS=cube$        for (int face = 0; face < 6; ++face) {
$if PARTS=cube$            texture.SetPixelData(texels, 0, (CubemapFace)face, face * (texels.Length / 6));
$if PARTS=cube$        }
$if WRAP_U=repeat$        texture.wrapModeU = TextureWrapMode.Repeat;
$if WRAP_U=clamp$        texture.wrapModeU = TextureWrapMode.Clamp;
$if WRAP_V=repeat$        texture.wrapModeV = TextureWrapMode.Repeat;
$if WRAP_V=clamp$        texture.wrapModeV = TextureWrapMode.Clamp;
$if DIM=3$$if WRAP_W=repeat$        texture.wrapModeW = TextureWrapMode.Repeat;
$if DIM=3$$if WRAP_W=clamp$        texture.wrapModeW = TextureWrapMode.Clamp;
$if FILTER=linear$        texture.filterMode = FilterMode.Bilinear;
$if FILTER=nearest$        texture.filterMode = FilterMode.Point;
        texture.Apply(false);
        AssetDatabase.CreateAsset(texture, Path.ChangeExtension(path, "asset"));
$if IS_SKY=yes$$if PARTS=none$        var skybox = new Material(Shader.Find("Skybox/Panoramic"));
$if IS_SKY=yes$$if PARTS=none$        skybox.SetTexture("_MainTex", texture);
$if IS_SKY=yes$$if PARTS=none$        skybox.SetFloat("_Rotation", 90);  // the shader has straight ahead at +x
$if IS_SKY=yes$$if PARTS=cube$        var skybox = new Material(Shader.Find("Skybox/Cubemap"));
$if IS_SKY=yes$$if PARTS=cube$        skybox.SetTexture("_Tex", texture);
$if IS_SKY=yes$        AssetDatabase.CreateAsset(skybox, Path.ChangeExtension(path, "mat"));
    }
$if IS_SKY=yes$
$if IS_SKY=yes$    [MenuItem("Tools/Skybake/Light with $NAME$")]
$if IS_SKY=yes$    static void LightScene() {
$if IS_SKY=yes$        foreach (string id in AssetDatabase.FindAssets("$NAME$ t:Material")) {
$if IS_SKY=yes$            string path = AssetDatabase.GUIDToAssetPath(id);
$if IS_SKY=yes$            if (Path.GetFileName(path) != "$NAME$.mat") continue;
$if IS_SKY=yes$            RenderSettings.skybox = AssetDatabase.LoadAssetAtPath<Material>(path);
$if IS_SKY=yes$        }
$if LAMP=yes$        var lamp = GameObject.Find("$NAME$ sun") ?? new GameObject("$NAME$ sun");
$if LAMP=yes$        if (!lamp.TryGetComponent(out Light sun)) sun = lamp.AddComponent<Light>();
$if LAMP=yes$        sun.type = LightType.Directional;
$if LAMP=yes$        sun.color = new Color($SUN_R$f, $SUN_G$f, $SUN_B$f).gamma;
$if LAMP=yes$        sun.intensity = $ENERGY$f;  // the irradiance of a surface that faces the sun, over pi
$if LAMP=yes$        sun.shadows = LightShadows.Soft;
$if LAMP=yes$        sun.transform.rotation = Quaternion.LookRotation(-new Vector3($SUN_RIGHT$f, $SUN_UP$f, $SUN_AHEAD$f));
$if LAMP=yes$        RenderSettings.sun = sun;
$if IS_SKY=yes$        DynamicGI.UpdateEnvironment();
$if IS_SKY=yes$    }
}
#endif
