// SPDX-License-Identifier: MIT
// The meshes and pictures of a grammar as surfaces and grey values.

#pragma once

#include "tests/reference/environments/map.h"
#include "tests/reference/environments/surface.h"
#include "tests/reference/grammar.h"

namespace lsys::reference {

// The file with that path. Precondition: the grammar has it.
const MeshFile& mesh_of(const Grammar& grammar, const std::string& path);
const PictureFile& picture_of(const Grammar& grammar, const std::string& path);

// The triangles of a mesh; a face with more than three corners is a fan.
Surface surface_of(const MeshFile& mesh);
// Half the area of the triangles, of an object at scale 1.
double half_area(const MeshFile& mesh);
// The greatest y minus the least y.
double length_of_object(const MeshFile& mesh);

// The grey values of a picture, 0 to 1: 0.2126 R + 0.7152 G + 0.0722 B as stored, over 255 or
// 65,535. Alpha is ignored.
GreyPicture grey_of(const PictureFile& picture);

// The text of the file: Wavefront OBJ.
std::string obj_text(const MeshFile& mesh);

} // namespace lsys::reference
