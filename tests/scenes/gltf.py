"""A writer of glTF 2.0: a scene is built call by call and saved as NAME.gltf and NAME.bin.

Every method that makes something returns its index in the file, to be named by what comes after.
Nothing is random and nothing is dated: the same calls write the same bytes. Numbers go out as
glTF wants them: accessors' bounds are those of the 32-bit floats in the buffer, buffer views start
at multiples of four, positions have min and max. Only the unusual (strides, sparse accessors,
strips) needs the lower half, `view` and `accessor`; the scenes mostly live on the upper half.
"""
import base64
import json
import math
import os
import struct
import zlib

BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
VERTICES, INDICES = 34962, 34963
TRIANGLES, STRIP, FAN = 4, 5, 6
CODES = {BYTE: "b", UBYTE: "B", SHORT: "h", USHORT: "H", UINT: "I", FLOAT: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
NEAREST, LINEAR, LINEAR_MIPMAP = 9728, 9729, 9987


def pack(rows, component):
    """The bytes of rows of numbers, packed tightly."""
    flat = [number for row in rows for number in row]
    return struct.pack("<%d%s" % (len(flat), CODES[component]), *flat)


def png(width, height, pixel):
    """A PNG, RGBA, 8 bits; pixel(x, y) gives four numbers from 0 to 255, row 0 on top."""
    def chunk(tag, data):
        return (struct.pack(">I", len(data)) + tag + data +
                struct.pack(">I", zlib.crc32(tag + data) & 0xffffffff))

    rows = bytearray()
    for y in range(height):
        rows.append(0)  # filter: none
        for x in range(width):
            rows += bytes(pixel(x, y))
    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) +
            chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


class Gltf:
    """One scene being written."""

    def __init__(self):
        self.doc = {"asset": {"version": "2.0", "generator": "gnomon tests/scenes"},
                    "scene": 0, "scenes": [{"nodes": []}], "nodes": []}
        self.data = bytearray()

    def put(self, kind, item):
        """Appends `item` to the file's array `kind`."""
        items = self.doc.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    # Buffers: the lower half.

    def view(self, data, target=None, stride=None):
        """Bytes as a buffer view, at a multiple of four."""
        while len(self.data) % 4:
            self.data.append(0)
        item = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}
        if stride:
            item["byteStride"] = stride
        if target:
            item["target"] = target
        self.data += data
        return self.put("bufferViews", item)

    def accessor(self, view, component, kind, count, offset=0, bounds=None, normalized=False,
                 sparse=None):
        """A typed window on a view (None: zeros); bounds are those of these rows, as stored."""
        item = {"componentType": component, "count": count, "type": kind}
        if view is not None:
            item["bufferView"] = view
            if offset:
                item["byteOffset"] = offset
        if normalized:
            item["normalized"] = True
        if bounds:
            stored = list(struct.iter_unpack("<%d%s" % (len(bounds[0]), CODES[component]),
                                             pack(bounds, component)))
            item["min"] = [min(column) for column in zip(*stored)]
            item["max"] = [max(column) for column in zip(*stored)]
        if sparse:
            item["sparse"] = sparse
        return self.put("accessors", item)

    def vertices(self, rows, kind="VEC3", bounds=False):
        """Rows of floats as an accessor with a view of its own."""
        view = self.view(pack(rows, FLOAT), VERTICES)
        return self.accessor(view, FLOAT, kind, len(rows), bounds=rows if bounds else None)

    def indices(self, numbers, component=None):
        """Vertex numbers as an accessor: 16 bits unless they do not fit or it is said otherwise.
        The largest number of a component type restarts strips, so it is never used."""
        if component is None:
            component = USHORT if max(numbers) < 0xffff else UINT
        view = self.view(pack([numbers], component), INDICES)
        return self.accessor(view, component, "SCALAR", len(numbers))

    # What is seen: the upper half.

    def texture(self, image, nearest=False, inline=False):
        """A texture of PNG bytes, kept in the buffer, or in the .gltf itself when `inline`."""
        if inline:
            source = {"uri": "data:image/png;base64," + base64.b64encode(image).decode("ascii")}
        else:
            source = {"bufferView": self.view(image), "mimeType": "image/png"}
        sampler = {"magFilter": NEAREST, "minFilter": NEAREST} if nearest else \
                  {"magFilter": LINEAR, "minFilter": LINEAR_MIPMAP}
        sampler = self.put("samplers", sampler)
        return self.put("textures", {"source": self.put("images", source), "sampler": sampler})

    def material(self, color, roughness=0.85, both=False, texture=None, alpha=None, cutoff=None,
                 metallic=0.0):
        """A material of a linear base colour (3 or 4 numbers); both: double-sided."""
        pbr = {"baseColorFactor": list(color) + [1.0] * (4 - len(color)),
               "metallicFactor": metallic, "roughnessFactor": roughness}
        if texture is not None:
            pbr["baseColorTexture"] = {"index": texture}
        item = {"pbrMetallicRoughness": pbr}
        if both:
            item["doubleSided"] = True
        if alpha:
            item["alphaMode"] = alpha
        if cutoff is not None:
            item["alphaCutoff"] = cutoff
        return self.put("materials", item)

    def primitive(self, shape, material, component=None):
        """The primitive of a Shape (shapes.py); component: of its indices."""
        attributes = {"POSITION": self.vertices(shape.points, bounds=True)}
        if shape.normals:
            attributes["NORMAL"] = self.vertices(shape.normals)
        if shape.uvs and "baseColorTexture" in self.doc["materials"][material][
                "pbrMetallicRoughness"]:
            attributes["TEXCOORD_0"] = self.vertices(shape.uvs, "VEC2")
        numbers = [corner for triangle in shape.triangles for corner in triangle]
        return {"attributes": attributes, "material": material,
                "indices": self.indices(numbers, component)}

    def mesh(self, shape, material):
        """A mesh of one Shape in one material."""
        return self.put("meshes", {"primitives": [self.primitive(shape, material)]})

    def node(self, name=None, parent=None, at=None, turn=None, scale=None, matrix=None, mesh=None,
             light=None, camera=None, gnomon=None):
        """A node under `parent`, or a root. gnomon: what the library's extras say of it."""
        item = {}
        if name:
            item["name"] = name
        if matrix:
            item["matrix"] = list(matrix)
        if at:
            item["translation"] = list(at)
        if turn:
            item["rotation"] = list(turn)
        if scale:
            item["scale"] = list(scale)
        if mesh is not None:
            item["mesh"] = mesh
        if camera is not None:
            item["camera"] = camera
        if light is not None:
            item["extensions"] = {"KHR_lights_punctual": {"light": light}}
        if gnomon:
            item["extras"] = {"gnomon": gnomon}
        index = self.put("nodes", item)
        if parent is None:
            self.doc["scenes"][0]["nodes"].append(index)
        else:
            self.doc["nodes"][parent].setdefault("children", []).append(index)
        return index

    def thing(self, shape, material, **place):
        """A Shape as a mesh at a node of its own: what most scenes are made of."""
        return self.node(mesh=self.mesh(shape, material), **place)

    # Lights and cameras.

    def light(self, kind, intensity, color=(1.0, 1.0, 1.0), cone=None, range=None):
        """A light: "point", "spot" (cone: inner and outer degrees from the axis) or
        "directional"; range: nothing farther is lit."""
        if "extensions" not in self.doc:
            self.doc["extensionsUsed"] = ["KHR_lights_punctual"]
            self.doc["extensions"] = {"KHR_lights_punctual": {"lights": []}}
        item = {"type": kind, "color": list(color), "intensity": intensity}
        if cone:
            item["spot"] = {"innerConeAngle": math.radians(cone[0]),
                            "outerConeAngle": math.radians(cone[1])}
        if range:
            item["range"] = range
        lights = self.doc["extensions"]["KHR_lights_punctual"]["lights"]
        lights.append(item)
        return len(lights) - 1

    def perspective(self, degrees=50.0, near=0.1, far=None):
        """A perspective camera; without `far` its far plane is at infinity."""
        lens = {"yfov": math.radians(degrees), "znear": near, "aspectRatio": 4.0 / 3.0}
        if far:
            lens["zfar"] = far
        return self.put("cameras", {"type": "perspective", "perspective": lens})

    def orthographic(self, ymag, near, far):
        """An orthographic camera for a 4:3 picture that shows 2 * ymag from foot to head."""
        lens = {"xmag": ymag * 4.0 / 3.0, "ymag": ymag, "znear": near, "zfar": far}
        return self.put("cameras", {"type": "orthographic", "orthographic": lens})

    # Motion.

    def animate(self, *channels):
        """One animation of (node, path, times, values) channels, all LINEAR."""
        samplers, targets = [], []
        for node, path, times, values in channels:
            kind = "VEC4" if path == "rotation" else "VEC3"
            keys = [(float(time),) for time in times]
            when = self.accessor(self.view(pack(keys, FLOAT)), FLOAT, "SCALAR", len(keys),
                                 bounds=keys)
            what = self.accessor(self.view(pack(values, FLOAT)), FLOAT, kind, len(values))
            targets.append({"sampler": len(samplers), "target": {"node": node, "path": path}})
            samplers.append({"input": when, "output": what, "interpolation": "LINEAR"})
        return self.put("animations", {"samplers": samplers, "channels": targets})

    def save(self, folder, name):
        """Writes folder/name.gltf and folder/name.bin."""
        self.doc["buffers"] = [{"byteLength": len(self.data), "uri": name + ".bin"}]
        with open(os.path.join(folder, name + ".bin"), "wb") as file:
            file.write(self.data)
        with open(os.path.join(folder, name + ".gltf"), "w", encoding="utf-8") as file:
            json.dump(self.doc, file, indent=1)
            file.write("\n")
