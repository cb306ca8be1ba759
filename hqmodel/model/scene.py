"""Strip, Group, Shape and Scene: what a hyperquadric model is, as frozen, validated values (preset format 1).

An edit makes a new value with `changed`; nothing is ever altered in place. Unknown keys are carried along as they came.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from math import hypot, sqrt
from typing import Annotated, Any, Final, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, Strict, field_validator, model_validator
from pydantic_core import PydanticCustomError

from .fields import FIELDS, MAX_SHAPES, MAX_STRIPS, shown

FORMAT: Final = "hqmodel"
VERSION: Final = 1
# How far from 1 the length of a stored quaternion may be; it is made exactly unit where it is used.
UNIT_TOLERANCE = 1e-3


def problem(expected: str, got: object) -> PydanticCustomError:
    """The error of one field, in the words the contract asks for."""
    return PydanticCustomError("hqmodel", "expected {expected}, got {got}", {"expected": expected, "got": shown(got)})


def _whole(value: Any) -> Any:
    """JSON does not tell 1 from 1.0, and true is not 1."""
    if isinstance(value, bool):
        raise problem("a whole number", value)
    return int(value) if isinstance(value, float) and value.is_integer() else value


Coordinate = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Scale = Annotated[float, Field(**FIELDS["shapes[].transform.scale[]"].constraints())]
Channel = Annotated[float, Field(**FIELDS["shapes[].color[]"].constraints())]
Vector = tuple[Coordinate, Coordinate, Coordinate]
Quaternion = tuple[Coordinate, Coordinate, Coordinate, Coordinate]
Sign = Annotated[Literal[1, -1], BeforeValidator(_whole)]
Axis = Literal["x", "y", "z"]
Flag = Annotated[bool, Strict()]


def vector(values: Iterable[float]) -> Vector:
    """Three numbers, a row of an array say, as plain floats; -0.0 is 0.0."""
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z


class Value(BaseModel):
    """A frozen value that keeps the keys it doesn't know."""

    model_config = ConfigDict(frozen=True, extra="allow", protected_namespaces=())

    def changed(self, **changes: Any) -> Self:
        """The same value with some fields changed, validated like a new one.

        Raises pydantic's ``ValidationError`` when the result would not be a valid value.
        """
        return type(self).model_validate({**self.__dict__, **(self.model_extra or {}), **changes})


class Strip(Value):
    """The region between two parallel bounding planes, |h| <= 1 (Hanson 1988, eqs. 11-13).

    h = (normal . p + slice t + offset) / half_width at a point p of the shape's own frame.
    """

    normal: Vector = FIELDS["shapes[].strips[].normal[]"].vector()
    slice: float = FIELDS["shapes[].strips[].slice"].field()
    offset: float = FIELDS["shapes[].strips[].offset"].field()
    half_width: float = FIELDS["shapes[].strips[].half_width"].field()
    gamma: float = FIELDS["shapes[].strips[].gamma"].field()
    sign: Sign = Field(default=1, title="Sign", description="1 closes the shape across the strip; -1 makes it hyperbolic.")
    group: str | None = Field(default=None, title="Group", description="The group whose outer exponent this strip shares.")

    @field_validator("normal")
    @classmethod
    def _not_zero(cls, normal: Vector) -> Vector:
        if hypot(*normal) == 0:
            raise problem("a normal that is not zero", normal)
        return normal


class Group(Value):
    """Strips raised together, sign (sum |h|^g)^(gamma/g), g their shared inner exponent (eqs. 7, 14)."""

    gamma: float = FIELDS["shapes[].groups{}.gamma"].field()
    sign: Sign = Field(default=1, title="Sign", description="-1 makes the group hyperbolic.")


class Transform(Value):
    """From the shape's own frame to the world: x = translation + rotate(scale * p)."""

    translation: Vector = FIELDS["shapes[].transform.translation[]"].vector()
    rotation: Quaternion = FIELDS["shapes[].transform.rotation[]"].vector()
    scale: tuple[Scale, Scale, Scale] = FIELDS["shapes[].transform.scale[]"].vector()

    @field_validator("rotation")
    @classmethod
    def _unit(cls, rotation: Quaternion) -> Quaternion:
        length = sqrt(sum(component * component for component in rotation)) if max(map(abs, rotation)) < 2 else 2.0
        if abs(length - 1) > UNIT_TOLERANCE:
            raise problem("a unit quaternion [x, y, z, w]", rotation)
        return rotation


class Shape(Value):
    """One hyperquadric, the term coefficient exp(hardness (constant - H)) of the sum (eqs. 13, 44)."""

    name: str = ""
    coefficient: float = FIELDS["shapes[].coefficient"].field()
    hardness: float = FIELDS["shapes[].hardness"].field()
    constant: float = FIELDS["shapes[].constant"].field()
    color: tuple[Channel, Channel, Channel] = FIELDS["shapes[].color[]"].vector()
    visible: Flag = True
    mirror: tuple[Axis, ...] = Field(default=(), description="World planes through the origin in which mirror images are added.")
    transform: Transform = Transform()
    groups: dict[str, Group] = Field(default_factory=dict)
    strips: tuple[Strip, ...]

    @field_validator("mirror")
    @classmethod
    def _once(cls, mirror: tuple[Axis, ...]) -> tuple[Axis, ...]:
        if len(set(mirror)) < len(mirror):
            raise problem("each axis once", mirror)
        return mirror

    @model_validator(mode="after")
    def _groups_agree(self) -> Self:
        if not self.strips:
            raise located(("strips",), "at least one strip", [])
        inner: dict[str, float] = {}
        for index, strip in enumerate(self.strips):
            if strip.group is None:
                continue
            here = ("strips", index)
            if strip.group not in self.groups:
                known = ", ".join(map(shown, self.groups)) or "but this shape has none"
                raise located((*here, "group"), f"the name of a group of this shape ({known})", strip.group)
            if strip.sign != 1:
                raise located((*here, "sign"), "1 in a group (the group has a sign of its own)", strip.sign)
            shared = inner.setdefault(strip.group, strip.gamma)
            if strip.gamma != shared:
                raise located((*here, "gamma"), f"{shared:g} like the group's other strips", strip.gamma)
        return self


class Scene(Value):
    """A whole preset: shapes blended into one body (eq. 44), and what the file says beside them."""

    format: Literal["hqmodel"] = FORMAT
    version: Annotated[Literal[1], BeforeValidator(_whole)] = VERSION
    name: str = ""
    description: str = ""
    author: str = ""
    license: str = ""
    dimension: Annotated[Literal[2, 3], BeforeValidator(_whole)] = 3
    slice: float = FIELDS["slice"].field()
    level: float = FIELDS["level"].field()
    shapes: tuple[Shape, ...] = Field(max_length=MAX_SHAPES)
    bounds: tuple[Vector, Vector] | None = Field(default=None, description=FIELDS["bounds[][]"].help)
    view: dict[str, Any] = Field(default_factory=dict, description="The modeller's camera and shading.")
    animations: tuple[dict[str, Any], ...] = Field(default=(), description="Named sweeps of numeric fields.")

    @model_validator(mode="before")
    @classmethod
    def _flat_normals(cls, data: Any) -> Any:
        """In two dimensions a normal may be written without its z component."""
        if not isinstance(data, Mapping) or data.get("dimension") != 2 or not isinstance(data.get("shapes"), list):
            return data
        return {**data, "shapes": [_with_flat_normals(shape) for shape in data["shapes"]]}

    @model_validator(mode="after")
    def _whole_scene(self) -> Self:
        strips = sum(len(shape.strips) for shape in self.shapes)
        if strips > MAX_STRIPS:
            raise located(("shapes",), f"at most {MAX_STRIPS} strips in all", strips)
        if self.bounds is not None:
            for axis, (low, high) in enumerate(zip(*self.bounds, strict=True)):
                if not low < high:
                    raise located(("bounds", 1, axis), f"a number above {low:g}", high)
        if self.dimension == 2:
            for i, shape in enumerate(self.shapes):
                for j, strip in enumerate(shape.strips):
                    if strip.normal[2] != 0:
                        raise located(("shapes", i, "strips", j, "normal", 2), "0 in two dimensions", strip.normal[2])
        return self

    @property
    def strip_count(self) -> int:
        return sum(len(shape.strips) for shape in self.shapes)


def _with_flat_normals(shape: Any) -> Any:
    if not isinstance(shape, dict) or not isinstance(shape.get("strips"), list):
        return shape
    strips = [
        {**strip, "normal": [*strip["normal"], 0.0]}
        if isinstance(strip, dict) and isinstance(strip.get("normal"), list) and len(strip["normal"]) == 2
        else strip
        for strip in shape["strips"]
    ]
    return {**shape, "strips": strips}


def located(where: tuple[str | int, ...], expected: str, got: object) -> PydanticCustomError:
    """Like `problem`, for a fault that a parent finds in one of its parts: `where` leads from the parent to it."""
    context = {"expected": expected, "got": shown(got), "where": where}
    return PydanticCustomError("hqmodel", "expected {expected}, got {got}", context)


def unused_name(wanted: str, taken: Collection[str]) -> str:
    """`wanted`, or `wanted 2`, `wanted 3`, ... whichever is free."""
    if wanted not in taken:
        return wanted
    number = 2
    while f"{wanted} {number}" in taken:
        number += 1
    return f"{wanted} {number}"
