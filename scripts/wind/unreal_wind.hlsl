// Wind for plants of `lsc export --wind-data` in Unreal 5. README.md has the formulas. Based on
// Unreal's documentation, not tried.
//
// Body of a Custom node with output type CMOT Float 3, for World Position Offset. Inputs:
//   At       LocalPosition (of the instance), in cm; Unreal is +Z up
//   UV1, UV2 TexCoord[1] and TexCoord[2]: TEXCOORD_1, in m, and TEXCOORD_2 of the file
//   Wind     a vector parameter: direction in the axes of the instance; its length is the strength,
//            1 is a storm
//   Height   a scalar parameter: height of the plant, in cm
//   Sway     a vector parameter: displacements of the top (x) and of a bough (y), as fractions of the
//            height: 0.1, 0.05
//   Seconds  the node Time, in s
// Transform the result with TransformVector from local to world space. Turn on "Use Full Precision
// UVs" of the static mesh: heights and distances are in metres.
float two_pi = 6.283185307;
float pivot = 100.0 * UV1.x;
float min_length = 0.01 * Height;
float relative_height = max(At.z, 0.0) / Height;
float3 trunk = Sway.x * Height * relative_height * relative_height *
    (0.7 + 0.3 * sin(two_pi * Seconds / 3.1)) * Wind.xyz;
float3 bough = Sway.y * Height * (1.0 - UV2.y) * (0.5 + 0.5 * pivot / Height) *
    (0.5 + 0.5 * sin(two_pi * (Seconds / 1.3 + UV2.x))) * Wind.xyz;
float3 displacement = trunk + bough;
displacement.z -= 0.5 * dot(trunk, trunk) / max(relative_height * Height, min_length) +
    0.5 * dot(bough, bough) / max(100.0 * UV1.y, min_length);
return displacement;
