# SPDX-License-Identifier: Apache-2.0
"""libextern_draco by ctypes, called as Blender's exporter and importer call it."""

import ctypes
from ctypes import c_bool, c_char_p, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p

import numpy as np

_SIGNATURES = {
    "encoderCreate": (c_void_p, [c_uint32]),
    "encoderRelease": (None, [c_void_p]),
    "encoderSetCompressionLevel": (None, [c_void_p, c_uint32]),
    "encoderSetQuantizationBits": (None, [c_void_p, c_uint32, c_uint32, c_uint32, c_uint32, c_uint32]),
    "encoderSetIndices": (None, [c_void_p, c_size_t, c_uint32, c_void_p]),
    "encoderSetAttribute": (c_uint32, [c_void_p, c_char_p, c_size_t, c_char_p, c_void_p]),
    "encoderEncode": (c_bool, [c_void_p, c_uint8]),
    "encoderGetEncodedVertexCount": (c_uint32, [c_void_p]),
    "encoderGetEncodedIndexCount": (c_uint32, [c_void_p]),
    "encoderGetByteLength": (c_uint64, [c_void_p]),
    "encoderCopy": (None, [c_void_p, c_void_p]),
    "decoderCreate": (c_void_p, []),
    "decoderRelease": (None, [c_void_p]),
    "decoderDecode": (c_bool, [c_void_p, c_void_p, c_size_t]),
    "decoderGetVertexCount": (c_uint32, [c_void_p]),
    "decoderGetIndexCount": (c_uint32, [c_void_p]),
    "decoderAttributeIsNormalized": (c_bool, [c_void_p, c_uint32]),
    "decoderReadAttribute": (c_bool, [c_void_p, c_uint32, c_size_t, c_char_p]),
    "decoderGetAttributeByteLength": (c_size_t, [c_void_p, c_uint32]),
    "decoderCopyAttribute": (None, [c_void_p, c_uint32, c_void_p]),
    "decoderReadIndices": (c_bool, [c_void_p, c_size_t]),
    "decoderGetIndicesByteLength": (c_size_t, [c_void_p]),
    "decoderCopyIndices": (None, [c_void_p, c_void_p]),
}
_COMPONENT = {np.dtype(kind): number for kind, number in (
    (np.int8, 5120), (np.uint8, 5121), (np.int16, 5122), (np.uint16, 5123), (np.uint32, 5125), (np.float32, 5126))}
_TYPE = {1: b"SCALAR", 2: b"VEC2", 3: b"VEC3", 4: b"VEC4"}


class Codec:
    def __init__(self, path):
        self.dll = ctypes.CDLL(str(path))
        for name, (result, arguments) in _SIGNATURES.items():
            function = getattr(self.dll, name)
            function.restype, function.argtypes = result, arguments

    def encode(self, attributes, indices, bits=(14, 10, 12, 10, 12), level=7, preserve_order=False):
        """(data, {name: id}, vertex count, index count); None where the library refuses."""
        dll = self.dll
        encoder = dll.encoderCreate(len(next(iter(attributes.values()))))
        try:
            ids = {name: dll.encoderSetAttribute(encoder, name.encode(), _COMPONENT[values.dtype],
                                                 _TYPE[values.shape[1]], values.tobytes())
                   for name, values in attributes.items()}
            dll.encoderSetIndices(encoder, _COMPONENT[indices.dtype], len(indices), indices.tobytes())
            dll.encoderSetCompressionLevel(encoder, level)
            dll.encoderSetQuantizationBits(encoder, *bits)
            if not dll.encoderEncode(encoder, preserve_order):
                return None
            data = bytes(dll.encoderGetByteLength(encoder))
            dll.encoderCopy(encoder, data)
            return data, ids, dll.encoderGetEncodedVertexCount(encoder), dll.encoderGetEncodedIndexCount(encoder)
        finally:
            dll.encoderRelease(encoder)

    def decode(self, data, ids, like, index_type=np.uint32):
        """({name: values}, indices) in the types of `like`; None where the library refuses."""
        dll = self.dll
        decoder = dll.decoderCreate()
        try:
            if not dll.decoderDecode(decoder, data, len(data)):
                return None
            vertices = dll.decoderGetVertexCount(decoder)
            result = {}
            for name, values in like.items():
                assert dll.decoderReadAttribute(decoder, ids[name], _COMPONENT[values.dtype], _TYPE[values.shape[1]])
                raw = bytes(dll.decoderGetAttributeByteLength(decoder, ids[name]))
                dll.decoderCopyAttribute(decoder, ids[name], raw)
                result[name] = np.frombuffer(raw, values.dtype).reshape(vertices, -1)
            assert dll.decoderReadIndices(decoder, _COMPONENT[np.dtype(index_type)])
            raw = bytes(dll.decoderGetIndicesByteLength(decoder))
            dll.decoderCopyIndices(decoder, raw)
            indices = np.frombuffer(raw, index_type)
            assert len(indices) == dll.decoderGetIndexCount(decoder)
            return result, indices
        finally:
            dll.decoderRelease(decoder)
