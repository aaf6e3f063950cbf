"""Calls of machine code: what fits is what Numba sees as the same types; nothing is mixed up."""

import ast
import contextlib
import ctypes
import functools
import gc
import math
import pickle
import struct
import sys
import threading
import weakref
from collections import namedtuple

import numba
import numpy as np
import pytest
from apparatus.native_library import addresses, echo, function, library, one, signature

from asperity.kernels.native import layout
from asperity.kernels.native.dtypes import described, read
from asperity.kernels.native.plan import Plan, UnknownTypeError

Pair = namedtuple("Pair", "first second")
Other = namedtuple("Other", "first second")

RECORD = np.dtype([("x", "f8"), ("n", "i8"), ("on", "?")])
LINED_UP = np.dtype(RECORD.descr, align=True)
NESTED = np.dtype([("of", RECORD), ("row", "f8", (3,)), ("last", "f4")])


def array(kind="<f8", ndim=1, order="C", *, writable=True):
    return ["A", described(np.dtype(kind)), ndim, order, writable, True]


def named(*members, of=Pair):
    return ["N", of.__module__, of.__qualname__, list(members)]


def spec_of(value):
    """What Numba takes a value for, as a table tells it."""
    types = numba.types

    def spec(kind):
        match kind:
            case types.Array():
                dtype = described(numba.np.numpy_support.as_dtype(kind.dtype))
                return ["A", dtype, kind.ndim, kind.layout, kind.mutable, kind.aligned]
            case types.Record():
                return ["R", described(numba.np.numpy_support.as_dtype(kind))]
            case types.NamedTuple() | types.NamedUniTuple():
                return named(*map(spec, kind.types), of=kind.instance_class)
            case types.BaseTuple():
                return ["T", [spec(member) for member in kind.types]]
        plain = {types.float64: "d", types.int64: "q", types.boolean: "b", types.none: "0"}
        return [plain.get(kind, "?")]

    return spec(numba.typeof(value))


def fixed(values):
    values.flags.writeable = False
    return values


def out_of_line():
    return np.zeros(17, np.int8)[1:].view(np.float64)


class Subarray(np.ndarray):
    pass


class Subfloat(float):
    pass


MATRIX = np.arange(12.0).reshape(3, 4)
VALUES = {
    "float": 1.5,
    "not a number": math.nan,
    "int": 3,
    "minus": -3,
    "largest": 2**63 - 1,
    "least": -(2**63),
    "unsigned": 2**63,
    "true": True,
    "false": False,
    "numpy's true": np.True_,
    "float64": np.float64(2.5),
    "float32": np.float32(2.5),
    "int64": np.int64(-4),
    "int32": np.int32(4),
    "uint64": np.uint64(4),
    "complex": 1j,
    "none": None,
    "empty": (),
    "tuple": (1.0, 2),
    "uniform": (1.0, 2.0),
    "three": (1.0, 2.0, 3.0),
    "pair": Pair(1.0, 2),
    "other pair": Other(1.0, 2),
    "nested": (1.0, Pair(MATRIX, (True, None))),
    "vector": np.arange(3.0),
    "empty vector": np.zeros(0),
    "one number": np.array(1.0),
    "stride": np.arange(6.0)[::2],
    "backwards": np.arange(6.0)[::-1],
    "fixed": fixed(np.arange(3.0)),
    "fixed stride": fixed(np.arange(6.0)[::2]),
    "ints": np.arange(3),
    "small ints": np.arange(3, dtype=np.int32),
    "singles": np.zeros(3, np.float32),
    "truths": np.zeros(3, bool),
    "matrix": MATRIX,
    "turned": MATRIX.T,
    "part": MATRIX[:, 1:3],
    "row": MATRIX[:1],
    "column": MATRIX[:, :1],
    "empty matrix": MATRIX[:0],
    "cube": np.zeros((2, 3, 4)),
    "cube in Fortran's order": np.zeros((2, 3, 4), order="F"),
    "record": np.zeros(2, RECORD)[1],
    "record lined up": np.zeros(2, LINED_UP)[1],
    "nested record": np.zeros(2, NESTED)[1],
    "records": np.zeros(2, RECORD),
    "records lined up": np.zeros(2, LINED_UP),
    "out of line": np.zeros(2, RECORD)["x"],
}
SPECS = {name: spec_of(value) for name, value in VALUES.items()}


def is_called(spec):
    with contextlib.suppress(UnknownTypeError):
        return bool(Plan([spec], 0))
    return False


CALLED = {name: spec for name, spec in SPECS.items() if is_called(spec)}


def test_most_types_of_arguments_are_called():
    assert SPECS.keys() - CALLED.keys() == {"unsigned", "float32", "int32", "uint64", "complex"}


@pytest.mark.ordinary(32)
@pytest.mark.parametrize("taken", CALLED)
def test_arguments_fit_where_numba_sees_the_same_type(taken):
    spec = CALLED[taken]
    call = one_way(spec)
    fits = {name for name, value in VALUES.items() if call((value,)) is not NotImplemented}
    # Numba does not look whether an array's numbers stand where the processor wants them.
    assert fits == {name for name, other in SPECS.items() if other == spec} - {"out of line"}


def one_way(spec):
    """A kernel of one argument that gives nothing back."""
    return _one_way(repr(spec))


@functools.cache
def _one_way(text):
    row = signature("echo", [ast.literal_eval(text)], ["0"])
    return one(row, function(row, [(None, 0)]))


@pytest.mark.parametrize(
    "value",
    [
        np.ma.zeros(3),
        np.zeros(3).view(Subarray),
        np.zeros(3, ">f8"),
        np.zeros(3, "m8[s]"),
        np.zeros(3, complex),
        np.zeros(3, object),
        [1.0, 2.0, 3.0],
        out_of_line(),
        Subfloat(1.0),
        np.longdouble(1.0),
        "text",
        object(),
        float,
        np.array([(1.0, 2, True)], RECORD).view(np.recarray)[0],
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_is_no_plain_value_fits_nothing(value):
    for spec in CALLED.values():
        assert one_way(spec)((value,)) is NotImplemented


def test_the_number_of_arguments_must_be_right():
    call = echo([["d"], ["q"], ["O", 3]], ["T", [["d"], ["q"]]])
    assert call((1.5, 2)) == (1.5, 2)
    for wrong in ((), (1.5,), (1.5, 2, 3)):
        assert call(wrong) is NotImplemented


@pytest.mark.parametrize("value", [0.0, -0.0, 5e-324, -math.inf, math.nan, np.float64(0.1)])
def test_a_float_keeps_its_bits(value):
    back = echo([["d"]], ["d"])((value,))
    assert type(back) is float
    assert struct.pack("d", back) == struct.pack("d", value)
    odd = struct.unpack("d", struct.pack("Q", 0x7FF8_0000_0000_0123))[0]
    assert struct.pack("d", echo([["d"]], ["d"])((odd,))) == struct.pack("d", odd)


@pytest.mark.ordinary(23)
@pytest.mark.parametrize("power", range(64))
def test_an_int_keeps_its_bits(power):
    call = echo([["q"]], ["q"])
    for value in (2**power - 1, -(2**power), 2**power // 3):
        assert call((value,)) == value
        assert call((np.int64(value),)) == value
    assert call((2**63,)) is call((-(2**63) - 1,)) is call((2**70,)) is NotImplemented


class Digits(ctypes.Structure):
    """An int as CPython 3.12 and later hold it: the sign in the lowest bits of the count."""

    _fields_ = (
        ("count", ctypes.c_int64),
        ("type", ctypes.c_int64),
        ("tag", ctypes.c_int64),
        ("digits", ctypes.c_uint32 * 4),
    )


@pytest.mark.parametrize(
    "value", [0, 1, -1, 2**30 - 1, -(2**30), 2**60 + 2**30, 2**63 - 1, -(2**63), 2**63, -(2**64)]
)
def test_an_int_of_later_pythons_is_read(value, monkeypatch):
    own = list(layout.types())
    own[layout.SIGN_IN_TAG] = 1
    later = (ctypes.c_int64 * len(own))(*own)
    monkeypatch.setattr(layout, "types", lambda: later)
    digits = [abs(value) >> shift & (2**30 - 1) for shift in (0, 30, 60, 90)]
    count = next((n for n in (4, 3, 2, 1) if digits[n - 1]), 0)
    sign = 0 if value > 0 else 2 if value else 1
    # Bit 2 says of a small number that it lives for ever.
    number = Digits(1, id(int), count << 3 | 4 | sign, (ctypes.c_uint32 * 4)(*digits))
    place = (ctypes.c_int64 * 5)(1, id(tuple), 1, ctypes.addressof(number))
    row = signature("echo", [["q"]], ["q"])
    address = addresses()
    look = ctypes.CFUNCTYPE(ctypes.c_int64, *[ctypes.c_int64] * 3)(address("asperity_gather"))
    plan = Plan(row["arguments"], 1)
    room = (ctypes.c_int64 * plan.room)()
    verdict = look(plan.address, ctypes.addressof(place), ctypes.addressof(room))
    if -(2**63) <= value < 2**63:
        assert (verdict, room[2]) == (0, value)
    else:
        assert verdict == -1


def test_the_place_of_a_tuples_members_follows_the_python():
    assert layout.types()[layout.ITEMS] == ().__sizeof__()


@pytest.mark.parametrize("name", ["true", "numpy's true", "false"])
def test_a_truth_comes_back_as_one(name):
    assert echo([["b"]], ["b"])((VALUES[name],)) is bool(VALUES[name])


def test_tuples_and_named_tuples_come_back_with_their_classes():
    spec = ["T", [["d"], named(["q"], ["T", [["b"], ["0"]]]), ["T", []]]]
    value = (1.5, Pair(2, (True, None)), ())
    back = echo([spec], spec)((value,))
    assert back == value
    assert type(back) is tuple
    assert type(back[1]) is Pair
    assert type(back[1].second[0]) is bool


@pytest.mark.ordinary(12)
@pytest.mark.parametrize(
    "name",
    [
        name
        for name, spec in CALLED.items()
        if spec[0] == "A" and "line" not in name and "record" not in name
    ],
)
def test_an_array_that_comes_back_as_it_went_is_the_same_object(name):
    value = VALUES[name]
    assert echo([SPECS[name]], SPECS[name])((value,)) is value
    inside = echo([["T", [["d"], SPECS[name]]]], ["T", [["d"], SPECS[name]]])
    assert inside(((1.0, value),))[1] is value


def behind(row, ndim=1):
    """Words of an array without its first item: address, count and length moved on."""
    return [0, 1, (2, -1), 3, (4, 8), (5, -1), *range(6, 5 + 2 * ndim)]


@pytest.mark.slow
def test_a_part_of_an_argument_that_comes_back_is_over_its_memory():
    spec = array()
    row = signature("part", [spec], spec)
    call = one(row, function(row, behind(row)))
    values = np.arange(4.0)
    gone = weakref.ref(values)
    part = call((values,))
    assert part.tolist() == [1.0, 2.0, 3.0]
    assert part.flags.writeable
    part[0] = 7.0
    assert values[1] == 7.0
    del values
    gc.collect()
    assert gone() is not None
    assert part.tolist() == [7.0, 2.0, 3.0]
    del part
    gc.collect()
    assert gone() is None


def test_an_array_over_a_records_memory_keeps_the_record():
    record = np.zeros(2, NESTED)[1]
    record["row"] = 1.0, 2.0, 3.0
    start = NESTED.fields["row"][1]
    spec = array()
    row = signature("row", [["R", described(NESTED)]], spec)
    words = [(None, 0), (None, 0), (None, 3), (None, 8), (0, start), (None, 3), (None, 8)]
    back = one(row, function(row, words))((record,))
    assert back.tolist() == [1.0, 2.0, 3.0]
    back[0] = 5.0
    assert record["row"][0] == 5.0


def test_memory_that_is_nobodys_is_copied():
    outside = (ctypes.c_double * 3)(1.0, 2.0, 3.0)
    spec = array()
    row = signature("outside", [], spec)
    words = [(None, word) for word in (0, 0, 3, 8, ctypes.addressof(outside), 3, 8)]
    back = one(row, function(row, words))(())
    outside[0] = 9.0
    assert back.tolist() == [1.0, 2.0, 3.0]


@pytest.mark.slow
def test_memory_that_a_kernel_allocated_goes_with_the_last_array_over_it():
    allocated = (ctypes.c_double * 3)(1.0, 2.0, 3.0)
    spec = array()
    row = signature("made", [], spec)
    words = [(None, word) for word in (4711, 0, 3, 8, ctypes.addressof(allocated), 3, 8)]
    made = library([row], function(row, words))
    released = (ctypes.c_int64 * 2).from_address(made._caller._address("released"))
    back = made.entry("kernel")(())
    part = back[1:]
    part[0] = 5.0
    assert allocated[1] == 5.0
    del back
    gc.collect()
    assert list(released) == [0, 0]
    del part
    gc.collect()
    assert list(released) == [1, 4711]


def test_an_array_changed_in_place_is_looked_at_anew():
    values = np.zeros((3, 4))
    call = one_way(array(ndim=2))
    assert call((values,)) is None
    values.flags.writeable = False
    assert call((values,)) is NotImplemented
    assert one_way(array(ndim=2, writable=False))((values,)) is None
    values.flags.writeable = True
    values.shape = (12,)
    assert call((values,)) is NotImplemented
    values.shape = (4, 3)
    echoed = echo([array(ndim=2)], array(ndim=2))
    assert echoed((values,)) is values
    values.resize((40, 3), refcheck=False)
    assert echoed((values,)) is values
    assert values.shape == (40, 3)


def test_equal_data_types_are_known_wherever_they_came_from():
    call = one_way(["R", described(RECORD)])
    for number in range(3 * layout.KNOWN):
        again = np.dtype({**dict(RECORD.fields)})
        assert again is not RECORD
        assert call((np.zeros(2, again)[number % 2],)) is None
    assert call((np.zeros(2, LINED_UP)[0],)) is NotImplemented
    renamed = np.dtype([("y", "f8"), ("n", "i8"), ("on", "?")])
    assert call((np.zeros(2, renamed)[0],)) is NotImplemented
    plain = one_way(array())
    assert plain((pickle.loads(pickle.dumps(np.zeros(3))),)) is None


@pytest.mark.parametrize(
    "dtype", [RECORD, LINED_UP, NESTED, np.dtype("f8"), np.dtype("?")], ids=str
)
def test_a_data_type_is_told_whole(dtype):
    assert described(read(described(dtype))) == described(dtype)
    numbas = numba.np.numpy_support
    assert described(numbas.as_dtype(numbas.from_dtype(dtype))) == described(dtype)


def test_the_signature_that_fits_is_called():
    rows = [signature(f"k{n}", [[kind]], ["q"]) for n, kind in enumerate("dqb")]
    texts = [function(row, [(None, n)]) for n, row in enumerate(rows)]
    call = library(rows, *texts).entry("kernel")
    assert [call((value,)) for value in (1.0, 1, True)] == [0, 1, 2]
    assert call((None,)) is NotImplemented


def test_a_signature_of_unknown_types_is_left_out():
    good = signature("k0", [["d"]], ["d"])
    bad = {"symbol": "k1", "arguments": [["?"]], "returns": ["d"], "words": [1, 1], "features": []}
    odd = {**good, "symbol": "k2", "words": [1, 2]}
    assert library([bad], function(good)).entry("kernel") is None
    assert library([odd], function(good)).entry("kernel") is None
    assert library([bad, odd, good], function(good)).entry("kernel")((2.0,)) == 2.0
    assert library([good], function(good)).entry("another") is None


def test_threads_do_not_see_each_others_arguments():
    spec = ["T", [["q"], ["q"], array(ndim=2)]]
    call = echo([["q"], ["q"], array(ndim=2)], spec)
    wrong = []

    def work(number):
        own = np.zeros((number + 1, 2))
        for turn in range(2000):
            first, second, back = call((number, turn, own))
            if (first, second) != (number, turn) or back is not own:
                wrong.append((number, turn))

    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        sys.setswitchinterval(before)
    assert not wrong


def test_a_call_leaves_no_references_behind():
    record, values, pair = np.zeros(2, RECORD)[0], np.zeros(3), Pair(1.0, 2)
    specs = [["R", described(RECORD)], array(), named(["d"], ["q"])]
    row = signature("echo", specs, ["0"])
    call = one(row, function(row, [(None, 0)]))
    arguments = record, values, pair
    call(arguments)
    before = [sys.getrefcount(each) for each in (*arguments, arguments, record.dtype)]
    for _ in range(1000):
        call(arguments)
    assert [sys.getrefcount(each) for each in (*arguments, arguments, record.dtype)] == before


def raising(content):
    """A kernel that stops with an exception, as it stands pickled in a library."""
    data = ctypes.create_string_buffer(content)
    info = (ctypes.c_int64 * 5)(ctypes.addressof(data), len(content), 0, 0, 0)
    row = signature("raises", [["d"]], ["d"])
    text = function(row, [(0, 0)], status=1).replace(
        "  ret", f"  store i64 {ctypes.addressof(info)}, ptr %room\n  ret"
    )
    return one(row, text), (data, info)


def test_an_exception_of_a_kernel_is_raised():
    content = pickle.dumps((ValueError, ("negative dimensions not allowed",), None))
    call, kept = raising(content)
    with pytest.raises(ValueError, match="negative dimensions not allowed"):
        call((1.0,))
    kept[1][3] = 1  # put together at run time
    with pytest.raises(RuntimeError, match="kernel stopped with status 1"):
        call((1.0,))


@pytest.mark.parametrize("content", [b"", b"garbage", pickle.dumps((3, (), None))])
def test_an_exception_that_cannot_be_read_is_told_by_its_status(content):
    call, _kept = raising(content)
    with pytest.raises(RuntimeError, match="kernel stopped with status 1"):
        call((1.0,))


def test_a_kernel_that_says_nothing_of_its_exception_is_told_by_its_status():
    row = signature("raises", [["d"]], ["d"])
    with pytest.raises(RuntimeError, match="kernel stopped with status -1"):
        one(row, function(row, status=-1))((1.0,))
    # What a kernel returns that gives None back.
    assert one(row, function(row, status=-2))((1.0,)) == 1.0


@pytest.mark.parametrize(
    "place",
    [
        *("ARRAY_DATA", "ARRAY_NDIM", "ARRAY_DTYPE", "ARRAY_FLAGS", "RECORD_DATA"),
        *("RECORD_DTYPE", "SCALAR", "TYPE", "SIZE", "DIGITS", "DTYPE_KIND"),
    ],
)
def test_a_python_that_holds_values_elsewhere_has_no_library(place, monkeypatch):
    assert layout.types.__wrapped__() is not None
    monkeypatch.setattr(layout, place, getattr(layout, place) + 8)
    assert layout.types.__wrapped__() is None
