#pragma once

#include <Imath/ImathVec.h>

namespace prt {

using Vec2f = Imath::V2f;
using Vec3f = Imath::V3f;
using Vec4f = Imath::V4f;
using Vec3d = Imath::V3d;

}  // namespace prt
