"""The machine code that looks at what a kernel is called with, as a compiler's text.

A kernel's call may cost a few microseconds. Python would need more to ask each array for its type,
shape and address, and what it knows of an array from the last call may be old. So the library has
a function that reads the objects where they stand, each time anew: it checks them as Numba would
and writes them down, one word of 64 bits each, as the kernel's machine code takes them. It runs
under the interpreter's lock, allocates nothing and changes no count of references.

Where CPython and NumPy hold what is read stands in `layout`, which is looked at before the first
call.
"""

from typing import Any

from asperity.kernels.native.layout import (
    ARRAY,
    ARRAY_DATA,
    ARRAY_DTYPE,
    ARRAY_FLAGS,
    ARRAY_NDIM,
    ARRAY_SHAPE,
    ARRAY_STRIDES,
    ARRAY_TYPE,
    BOOL,
    DIGITS,
    DTYPE_KIND,
    FALSES,
    FLOAT,
    FLOAT_TYPES,
    INT,
    INT64_TYPE,
    INT_TYPE,
    ITEMS,
    KNOWN,
    NONE,
    NONE_AT,
    RECORD,
    RECORD_DATA,
    RECORD_DTYPE,
    ROW,
    ROWS,
    SCALAR,
    SIGN_IN_TAG,
    SIZE,
    TRUES,
    TUPLE,
    TYPE,
    TYPES,
    VOID_TYPE,
)

NAME = "asperity_gather"
UNFIT = -1


def ir() -> str:
    """Return the function as text of LLVM's intermediate representation, for any processor.

    It is ``int64 asperity_gather(int64 *plan, PyObject *arguments, int64 *room)``. It returns zero
    where the arguments fit the plan; -1 where they do not; and the number of a row, from one, that
    holds a data type not seen before, which Python has to look at.
    """
    import llvmlite.ir as ll

    return str(_Writer(ll).module)


class _Writer:
    def __init__(self, ll: Any) -> None:
        self.ll = ll
        self.word = ll.IntType(64)
        self.half = ll.IntType(32)
        self.module = ll.Module("asperity_gather")
        kind = ll.FunctionType(self.word, [self.word] * 3)
        self.function = ll.Function(self.module, kind, NAME)
        self.plan, self.arguments, self.room = self.function.args
        self.b = ll.IRBuilder(self.function.append_basic_block("entry"))
        self.unfit = self.function.append_basic_block("unfit")
        self._write()

    def const(self, value: int) -> Any:
        return self.ll.Constant(self.word, value)

    def load(self, address: Any, offset: Any = 0, kind: Any = None) -> Any:
        """Return the word (or a smaller integer) that stands so many bytes behind an address."""
        offset = self.const(offset) if isinstance(offset, int) else offset
        kind = kind or self.word
        place = self.b.inttoptr(self.b.add(address, offset), kind.as_pointer())
        return self.b.load(place)

    def half_at(self, address: Any, offset: Any = 0) -> Any:
        return self.b.zext(self.load(address, offset, self.half), self.word)

    def store(self, value: Any, address: Any) -> None:
        self.b.store(value, self.b.inttoptr(address, self.word.as_pointer()))

    def is_(self, first: Any, second: Any) -> Any:
        second = self.const(second) if isinstance(second, int) else second
        return self.b.icmp_signed("==", first, second)

    def must(self, condition: Any) -> None:
        good = self.function.append_basic_block("good")
        self.b.cbranch(condition, good, self.unfit)
        self.b.position_at_end(good)

    def variable(self, name: str, start: Any) -> Any:
        with self.b.goto_entry_block():
            place = self.b.alloca(self.word, name=name)
        self.b.store(start, place)
        return place

    def advance(self, place: Any, step: int) -> None:
        self.b.store(self.b.add(self.b.load(place), self.const(step)), place)

    def put(self, value: Any) -> None:
        """Write the next word of the kernel's arguments."""
        value = self.const(value) if isinstance(value, int) else value
        self.store(value, self.b.load(self.next))
        self.advance(self.next, 8)

    def common(self, index: int) -> Any:
        return self.load(self.types, 8 * index)

    def field(self, index: int) -> Any:
        return self.load(self.b.load(self.row), 8 * index)

    def _write(self) -> None:
        b = self.b
        self.types = self.load(self.plan, 8 * TYPES)
        count = self.load(self.plan, 8 * ROWS)
        self.items = self.common(ITEMS)
        first = self.load(self.plan, 8 * 2)
        self.next = self.variable("next", b.add(self.room, first))
        self.scratch = b.add(self.room, self.load(self.plan, 8 * 3))
        self.row = self.variable("row", b.add(self.plan, self.const(8 * 5)))
        self.left = self.variable("left", count)
        # The arguments are the tuple of number nought.
        self.must(self.is_(self.load(self.arguments, SIZE), self.load(self.plan, 8 * 4)))
        self.store(b.add(self.arguments, self.items), self.scratch)

        again, done = (self.function.append_basic_block(name) for name in ("again", "done"))
        self.forward = self.function.append_basic_block("forward")
        b.branch(again)
        b.position_at_end(again)
        self.must_not_be_done(done)
        within = self.load(b.add(self.scratch, self.field(1)))
        self.object = self.load(within, self.field(2))
        self.type = self.load(self.object, TYPE)
        switch = b.switch(self.field(0), self.unfit)
        for kind, write in (
            (NONE, self._none),
            (FLOAT, self._float),
            (INT, self._int),
            (BOOL, self._bool),
            (ARRAY, self._array),
            (RECORD, self._record),
            (TUPLE, self._tuple),
        ):
            block = self.function.append_basic_block("kind")
            switch.add_case(self.const(kind), block)
            b.position_at_end(block)
            write()
            b.branch(self.forward)
        b.position_at_end(self.forward)
        self.advance(self.row, 8 * ROW)
        self.advance(self.left, -1)
        b.branch(again)
        b.position_at_end(done)
        b.ret(self.const(0))
        b.position_at_end(self.unfit)
        b.ret(self.const(UNFIT))

    def must_not_be_done(self, done: Any) -> None:
        more = self.function.append_basic_block("more")
        self.b.cbranch(self.is_(self.b.load(self.left), 0), done, more)
        self.b.position_at_end(more)

    def _none(self) -> None:
        self.must(self.is_(self.object, self.common(NONE_AT)))
        self.put(0)

    def _float(self) -> None:
        fits = [self.is_(self.type, self.common(each)) for each in FLOAT_TYPES]
        self.must(self.b.or_(*fits))
        self.put(self.load(self.object, SCALAR))

    def _bool(self) -> None:
        true, false = (
            self.b.or_(*(self.is_(self.object, self.common(each)) for each in objects))
            for objects in (TRUES, FALSES)
        )
        self.must(self.b.or_(true, false))
        self.put(self.b.zext(true, self.word))

    def _int(self) -> None:
        b = self.b
        value = self.variable("value", self.const(0))
        with b.if_else(self.is_(self.type, self.common(INT64_TYPE))) as (is_numpy, is_python):
            with is_numpy:
                b.store(self.load(self.object, SCALAR), value)
            with is_python:
                self.must(self.is_(self.type, self.common(INT_TYPE)))
                self._digits(value)
        self.put(b.load(value))

    def _digits(self, value: Any) -> None:
        """Put together a Python int of up to three digits of 30 bits."""
        b = self.b
        head = self.load(self.object, SIZE)
        # Since Python 3.12 the number of digits stands above three bits that hold the sign.
        in_tag = self.is_(self.common(SIGN_IN_TAG), 1)
        minus = b.icmp_signed("<", head, self.const(0))
        size = b.select(minus, b.neg(head), head)
        size = b.select(in_tag, b.lshr(head, self.const(3)), size)
        sign_bits = b.and_(head, self.const(3))
        minus = b.select(in_tag, self.is_(sign_bits, 2), minus)
        self.must(b.icmp_unsigned("<=", size, self.const(3)))
        magnitude = self.variable("magnitude", self.const(0))
        for digit in range(3):
            with b.if_then(b.icmp_unsigned(">", size, self.const(digit))):
                part = self.half_at(self.object, DIGITS + 4 * digit)
                if digit == 2:
                    # More than 64 bits.
                    self.must(b.icmp_unsigned("<", part, self.const(16)))
                part = b.shl(part, self.const(30 * digit))
                b.store(b.or_(b.load(magnitude), part), magnitude)
        size = b.load(magnitude)
        # What an int64 holds: one more below zero than above.
        most = b.add(self.const(2**63 - 1), b.zext(minus, self.word))
        self.must(b.icmp_unsigned("<=", size, most))
        b.store(b.select(minus, b.neg(size), size), value)

    def _array(self) -> None:
        b = self.b
        self.must(self.is_(self.type, self.common(ARRAY_TYPE)))
        ndim = self.half_at(self.object, ARRAY_NDIM)
        self.must(self.is_(ndim, self.field(4)))
        flags = self.half_at(self.object, ARRAY_FLAGS)
        self.must(self.is_(b.and_(flags, self.field(5)), self.field(6)))
        self._dtype(ARRAY_DTYPE)
        self.put(0)  # a count of references and an owner, which Numba's own calls give
        self.put(0)
        count = b.load(self.next)
        self.put(1)
        self.put(self.load(self.field(7), 8))
        self.put(self.load(self.object, ARRAY_DATA))
        end = b.mul(ndim, self.const(8))
        for where in (ARRAY_SHAPE, ARRAY_STRIDES):
            start = self.load(self.object, where)
            at = self.variable("at", self.const(0))
            head, body, after = (
                self.function.append_basic_block(name) for name in ("head", "body", "after")
            )
            b.branch(head)
            b.position_at_end(head)
            b.cbranch(b.icmp_unsigned("<", b.load(at), end), body, after)
            b.position_at_end(body)
            value = self.load(start, b.load(at))
            self.put(value)
            if where == ARRAY_SHAPE:
                self.store(b.mul(self.load(count), value), count)
            self.advance(at, 8)
            b.branch(head)
            b.position_at_end(after)

    def _record(self) -> None:
        self.must(self.is_(self.type, self.common(VOID_TYPE)))
        self._dtype(RECORD_DTYPE)
        self.put(self.load(self.object, RECORD_DATA))

    def _dtype(self, where: int) -> None:
        """Look whether a data type is known: as a plain number's, or by its address."""
        b = self.b
        dtype, known = self.load(self.object, where), self.field(7)
        plain = self.load(known)
        fits = b.and_(
            b.icmp_signed("!=", plain, self.const(0)), self.is_(self.load(dtype, DTYPE_KIND), plain)
        )
        for each in range(KNOWN):
            fits = b.or_(fits, self.is_(dtype, self.load(known, 8 * (2 + each))))
        good, strange = (self.function.append_basic_block(name) for name in ("known", "strange"))
        b.cbranch(fits, good, strange)
        b.position_at_end(strange)
        count = self.load(self.plan, 8 * ROWS)
        b.ret(b.add(b.sub(count, b.load(self.left)), self.const(1)))
        b.position_at_end(good)

    def _tuple(self) -> None:
        b = self.b
        self.must(self.is_(self.type, self.field(4)))
        self.must(self.is_(self.load(self.object, SIZE), self.field(5)))
        self.store(b.add(self.object, self.items), b.add(self.scratch, self.field(3)))
