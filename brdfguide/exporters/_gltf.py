"""glTF's words for what every shader has: of its own file, and of MaterialX's node that has them too."""

from ..models import term
from ._nodes import Node

LAW = term("gltf")
NODE = Node(
    law=LAW,
    roughness="roughness",
    metalness="metallic",
    index="ior",
    weight="specular",
    edge="",
    coat="clearcoat",
    coat_roughness="clearcoat_roughness",
    coat_index="",
    matt={"specular": 0.0, "roughness": 1.0},
    by_schlick=True,
    grain="anisotropy_strength",
)
