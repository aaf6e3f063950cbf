"""Linear elastic bodies on hexahedral meshes, condensed to the nodes that may touch."""

from asperity.contact.elastic.body import ElasticBody, elastic_body
from asperity.contact.elastic.condense import condense, machine_memory, memory_for
from asperity.contact.elastic.condensed import CondensedBody
from asperity.contact.elastic.loads import Load, Pressure, Traction
from asperity.contact.elastic.material import ElasticMaterial

__all__ = [
    "CondensedBody",
    "ElasticBody",
    "ElasticMaterial",
    "Load",
    "Pressure",
    "Traction",
    "condense",
    "elastic_body",
    "machine_memory",
    "memory_for",
]
