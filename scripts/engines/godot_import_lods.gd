# Makes a scene of the levels of detail of a plant, for Godot 4: each level is visible within a range of distances.
# Copy tree.lods.json and the files that it names into the project, set LIST, and run this with File > Run of the script
# editor. The files are written by `lsc export --lods N --lod-files`. Based on the documentation of
# GeometryInstance3D.visibility_range_begin, not tried in Godot.
@tool
extends EditorScript

const LIST := "res://trees/tree.lods.json"


func _run() -> void:
	var list = JSON.parse_string(FileAccess.get_file_as_string(LIST))
	if list == null:
		push_error("%s: no list of levels" % LIST)
		return
	var levels: Array = list["levels"]
	var root := Node3D.new()
	root.name = LIST.get_file().get_slice(".", 0)
	for number in levels.size():
		var path: String = LIST.get_base_dir().path_join(levels[number]["file"])
		var scene := load(path) as PackedScene
		if scene == null:
			push_error("%s: not imported" % path)
			return
		var node := scene.instantiate()
		node.name = "LOD%d" % number
		root.add_child(node)
		node.owner = root
		var begin: float = levels[number]["distance"]
		# The last level has no end, which Godot expresses by 0.
		var end: float = levels[number + 1]["distance"] if number + 1 < levels.size() else 0.0
		root.set_editable_instance(node, true)
		for mesh in node.find_children("*", "GeometryInstance3D", true, false):
			mesh.visibility_range_begin = begin
			mesh.visibility_range_end = end
	var packed := PackedScene.new()
	packed.pack(root)
	var out := LIST.get_base_dir().path_join(root.name + ".tscn")
	if ResourceSaver.save(packed, out) != OK:
		push_error("%s: not saved" % out)
	root.free()
