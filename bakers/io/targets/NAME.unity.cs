$if PARTS=none$// Makes $NAME$.asset, a texture of $WIDTH$ x $HEIGHT$ x $DEPTH$ texels, of $FILE$ whenever that file changes: copy
$if PARTS=cube$// Makes $NAME$.asset, a Cubemap with faces of $WIDTH$ x $WIDTH$ texels, of $FILE$ whenever that file changes: copy
// all files of this name into one folder of Assets, and use $NAME$.asset.
$if PARTS=cube$// Straight ahead is +z, up +y and right +x, as in Unity.
$if PARTS=none$// Texel (0, 0, 0) is at the lowest coordinates, as in the lookup that
$if PARTS=none$// `skybake info --lookup $FILE$ --language hlsl` prints.
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

    static void OnPostprocessAllAssets(string[] imported, string[] deleted, string[] moved, string[] from) {
        foreach (string path in imported) {
            if (Path.GetFileName(path) == "$FILE$") Make(path);
        }
    }

    // The file may have been imported before this script was compiled.
    [InitializeOnLoadMethod]
    static void MakeMissing() {
        foreach (string id in AssetDatabase.FindAssets("$NAME$")) {
            string path = AssetDatabase.GUIDToAssetPath(id);
            bool isMissing = !File.Exists(Path.ChangeExtension(path, "asset"));
            if (Path.GetFileName(path) == "$FILE$" && isMissing) EditorApplication.delayCall += () => Make(path);
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

    static void Make(string path) {
        TextureFormat format = channels == 1 ? one : channels == 2 ? two : four;
$if PARTS=cube$        var texture = new Cubemap($WIDTH$, format, false);
$if PARTS=none$$if DIM=2$        var texture = new Texture2D($WIDTH$, $HEIGHT$, format, false, true);
$if DIM=3$        var texture = new Texture3D($WIDTH$, $HEIGHT$, $DEPTH$, format, false);
        byte[] texels = Padded(File.ReadAllBytes(path));
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
    }
}
#endif
