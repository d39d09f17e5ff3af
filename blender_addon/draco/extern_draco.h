// SPDX-License-Identifier: GPL-3.0-or-later
// The C interface that Blender's glTF exporter and importer reach through ctypes. Names and
// signatures are theirs: io_scene_gltf2/io/exp/gltf2_io_draco_compression_extension.py and its twin
// for import. Component types are glTF's numbers (5120 … 5126), types its words ("VEC3").
#pragma once

#include <cstddef>
#include <cstdint>

#define EXTERN_DRACO_API extern "C" __attribute__((visibility("default")))

struct Encoder;
struct Decoder;

EXTERN_DRACO_API Encoder* encoderCreate(uint32_t vertex_count);
EXTERN_DRACO_API void encoderRelease(Encoder* encoder);
// 0 is fastest, 10 smallest.
EXTERN_DRACO_API void encoderSetCompressionLevel(Encoder* encoder, uint32_t level);
// Bits for each kind of attribute; 0 keeps the floats as they are.
EXTERN_DRACO_API void encoderSetQuantizationBits(Encoder* encoder, uint32_t position, uint32_t normal,
                                                 uint32_t texcoord, uint32_t color, uint32_t generic);
EXTERN_DRACO_API void encoderSetIndices(Encoder* encoder, size_t component_type, uint32_t count,
                                        const void* indices);
// Returns the attribute's id in the encoded data.
EXTERN_DRACO_API uint32_t encoderSetAttribute(Encoder* encoder, const char* name, size_t component_type,
                                              const char* type, const void* data);
// preserve_order keeps every vertex and triangle where it is: morph targets lie beside the encoded
// data and refer to vertices by number.
EXTERN_DRACO_API bool encoderEncode(Encoder* encoder, uint8_t preserve_order);
EXTERN_DRACO_API uint32_t encoderGetEncodedVertexCount(Encoder* encoder);
EXTERN_DRACO_API uint32_t encoderGetEncodedIndexCount(Encoder* encoder);
EXTERN_DRACO_API uint64_t encoderGetByteLength(Encoder* encoder);
EXTERN_DRACO_API void encoderCopy(Encoder* encoder, void* out);

EXTERN_DRACO_API Decoder* decoderCreate();
EXTERN_DRACO_API void decoderRelease(Decoder* decoder);
EXTERN_DRACO_API bool decoderDecode(Decoder* decoder, const void* data, size_t byte_length);
EXTERN_DRACO_API uint32_t decoderGetVertexCount(Decoder* decoder);
EXTERN_DRACO_API uint32_t decoderGetIndexCount(Decoder* decoder);
EXTERN_DRACO_API bool decoderAttributeIsNormalized(Decoder* decoder, uint32_t id);
EXTERN_DRACO_API bool decoderReadAttribute(Decoder* decoder, uint32_t id, size_t component_type,
                                           const char* type);
EXTERN_DRACO_API size_t decoderGetAttributeByteLength(Decoder* decoder, uint32_t id);
EXTERN_DRACO_API void decoderCopyAttribute(Decoder* decoder, uint32_t id, void* out);
EXTERN_DRACO_API bool decoderReadIndices(Decoder* decoder, size_t component_type);
EXTERN_DRACO_API size_t decoderGetIndicesByteLength(Decoder* decoder);
EXTERN_DRACO_API void decoderCopyIndices(Decoder* decoder, void* out);
