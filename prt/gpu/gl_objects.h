#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "prt/gpu/gl_name.h"

namespace prt {

/// A buffer of so many bytes, at least one, uninitialised.
///
/// @param what    how an error calls it
/// @throws Error  outOfMemory
GlName makeBuffer(std::size_t byteCount, const std::string& what);

/// Writes to bytes [offset, offset + bytes.size()) of a buffer.
void writeBuffer(const GlName& buffer, std::size_t offset, std::span<const std::byte> bytes);

/// Reads a buffer's first bytes, when all that was asked for before is done.
void readBuffer(const GlName& buffer, std::span<std::byte> bytes);

/// A buffer that holds these values.
template <class Value>
GlName makeBuffer(std::span<const Value> values, const std::string& what) {
    GlName buffer = makeBuffer(values.size_bytes(), what);
    writeBuffer(buffer, 0, std::as_bytes(values));
    return buffer;
}

/// @throws Error  outOfMemory if OpenGL had no memory for something since the last call
void checkGpuMemory(const std::string& what);

/// @param largestBytes  of a buffer that a vertex shader will read
/// @throws Error        unsupported where vertex shaders read none, limitExceeded for one so large
void requireShaderBuffers(std::size_t largestBytes);

/// A texture without storage, bound to the first unit.
///
/// @param target  in OpenGL's names
GlName makeTexture(unsigned target);

/// @param what    how an error calls the texture
/// @param hint    what the user can do
/// @throws Error  limitExceeded for one wider or higher than the driver takes
void requireTextureSize(int width, int height, const std::string& what, const std::string& hint);

/// How a texture without levels of detail is read, in OpenGL's names.
GlName makeSampler(int wrapU, int wrapV, int filter);

}  // namespace prt
