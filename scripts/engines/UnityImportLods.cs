// Makes a prefab with an LODGroup of the levels of detail of a plant, for Unity 2021 or later. Put this file into a folder
// `Editor`, and tree.lods.json with the files that it names into the project (GLB needs the package glTFast; Unity itself
// reads OBJ and other formats). Select the list and use Assets > Make LOD prefab. The files are written by
// `lsc export --lods N --lod-files`. Based on the documentation of LODGroup and MeshCollider, not tried in Unity.
using System;
using System.IO;
using System.Linq;
using UnityEditor;
using UnityEngine;

public static class UnityImportLods
{
    [Serializable]
    private class Level
    {
        public string file = "";
        public float screen_height;
    }

    [Serializable]
    private class LevelList
    {
        public Level[] levels = new Level[0];
    }

    private const int MaxLevels = 8; // max number of levels of an LODGroup

    [MenuItem("Assets/Make LOD prefab", true)]
    private static bool CanMake()
    {
        return AssetDatabase.GetAssetPath(Selection.activeObject).EndsWith(".lods.json");
    }

    [MenuItem("Assets/Make LOD prefab")]
    private static void Make()
    {
        string path = AssetDatabase.GetAssetPath(Selection.activeObject);
        string folder = Path.GetDirectoryName(path).Replace('\\', '/');
        string name = Path.GetFileName(path).Replace(".lods.json", "");
        Level[] levels = JsonUtility.FromJson<LevelList>(File.ReadAllText(path)).levels;
        if (levels.Length > MaxLevels) // keep the first levels and the last one, the impostor
        {
            levels = levels.Take(MaxLevels - 1).Append(levels.Last()).ToArray();
        }
        var root = new GameObject(name);
        var lods = new LOD[levels.Length];
        for (int i = 0; i < levels.Length; ++i)
        {
            string file = folder + "/" + levels[i].file;
            var model = AssetDatabase.LoadAssetAtPath<GameObject>(file);
            if (model == null)
            {
                UnityEngine.Object.DestroyImmediate(root);
                throw new FileNotFoundException("not imported as a model", file);
            }
            var child = (GameObject)PrefabUtility.InstantiatePrefab(model, root.transform);
            child.name = name + "_LOD" + i;
            Renderer[] all = child.GetComponentsInChildren<Renderer>();
            Renderer[] shapes = all.Where(each => each.name.Contains("_collider_")).ToArray();
            foreach (Renderer shape in shapes) // collision shapes, named by --collision-names unity
            {
                shape.enabled = false;
                var collider = shape.gameObject.AddComponent<MeshCollider>();
                collider.sharedMesh = shape.GetComponent<MeshFilter>().sharedMesh;
                collider.convex = true;
            }
            // A level ends where the next one begins; the last is never hidden.
            float end = i + 1 < levels.Length ? levels[i + 1].screen_height : 0.0f;
            lods[i] = new LOD(end, all.Except(shapes).ToArray());
        }
        var group = root.AddComponent<LODGroup>();
        group.SetLODs(lods);
        group.RecalculateBounds();
        PrefabUtility.SaveAsPrefabAsset(root, folder + "/" + name + ".prefab");
        UnityEngine.Object.DestroyImmediate(root);
    }
}
