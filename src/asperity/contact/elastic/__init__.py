"""Linear elastic bodies on hexahedral meshes, condensed to the nodes that may touch."""

from asperity.contact.elastic.body import ElasticBody, elastic_body
from asperity.contact.elastic.condense import condense, machine_memory, memory_for, memory_needed
from asperity.contact.elastic.condensed import CondensedBody, LoadResponse
from asperity.contact.elastic.loads import Force, Load, Pressure, Traction
from asperity.contact.elastic.material import ElasticMaterial

__all__ = [
    "CondensedBody",
    "ElasticBody",
    "ElasticMaterial",
    "Force",
    "Load",
    "LoadResponse",
    "Pressure",
    "Traction",
    "condense",
    "elastic_body",
    "machine_memory",
    "memory_for",
    "memory_needed",
]
