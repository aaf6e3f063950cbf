"""What compiled kernels need beside their own code: memory that is counted, without Numba.

A block of memory begins with five words: how many hold it, what is called at the end with which
information, where its data begin, how many bytes they are. Numba's compiled code counts by itself
and calls what stands here to make a block and to give it up.
"""

_ALLOCATION = """
%block = type { i64, ptr, ptr, ptr, i64 }
declare noalias ptr @malloc(i64)
declare void @free(ptr)

define linkonce_odr noalias ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %alignment) {
  %wide = zext i32 %alignment to i64
  %none = icmp eq i64 %wide, 0
  %step = select i1 %none, i64 16, i64 %wide
  %padded = add i64 %step, 40
  %total = add i64 %size, %padded
  %wrapped = icmp ult i64 %total, %size
  br i1 %wrapped, label %failed, label %ask
ask:
  %made = call ptr @malloc(i64 %total)
  %missing = icmp eq ptr %made, null
  br i1 %missing, label %failed, label %fill
fill:
  %address = ptrtoint ptr %made to i64
  %least = add i64 %address, 39
  %beyond = add i64 %least, %step
  %over = urem i64 %beyond, %step
  %place = sub i64 %beyond, %over
  %data = inttoptr i64 %place to ptr
  store i64 1, ptr %made
  %p1 = getelementptr %block, ptr %made, i32 0, i32 1
  store ptr null, ptr %p1
  %p2 = getelementptr %block, ptr %made, i32 0, i32 2
  store ptr null, ptr %p2
  %p3 = getelementptr %block, ptr %made, i32 0, i32 3
  store ptr %data, ptr %p3
  %p4 = getelementptr %block, ptr %made, i32 0, i32 4
  store i64 %size, ptr %p4
  ret ptr %made
failed:
  ret ptr null
}

define linkonce_odr noalias ptr @NRT_MemInfo_alloc(i64 %size) {
  %made = call ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 16)
  ret ptr %made
}

define linkonce_odr noalias ptr @NRT_MemInfo_alloc_safe_aligned(i64 %size, i32 %alignment) {
  %made = call ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %alignment)
  ret ptr %made
}

define linkonce_odr noalias ptr @NRT_Allocate(i64 %size) {
  %made = call ptr @malloc(i64 %size)
  ret ptr %made
}

define linkonce_odr void @NRT_Free(ptr %made) {
  call void @free(ptr %made)
  ret void
}

define linkonce_odr void @NRT_MemInfo_call_dtor(ptr %block) {
  %p1 = getelementptr %block, ptr %block, i32 0, i32 1
  %last = load ptr, ptr %p1
  %nothing = icmp eq ptr %last, null
  br i1 %nothing, label %give, label %end
end:
  %p2 = getelementptr %block, ptr %block, i32 0, i32 2
  %about = load ptr, ptr %p2
  %p3 = getelementptr %block, ptr %block, i32 0, i32 3
  %data = load ptr, ptr %p3
  %p4 = getelementptr %block, ptr %block, i32 0, i32 4
  %size = load i64, ptr %p4
  call void %last(ptr %data, i64 %size, ptr %about)
  br label %give
give:
  call void @free(ptr %block)
  ret void
}
"""

_RELEASE = """
define void @asperity_release(ptr %block) {
  %before = atomicrmw sub ptr %block, i64 1 monotonic
  %last = icmp eq i64 %before, 1
  br i1 %last, label %end, label %done
end:
  call void @NRT_MemInfo_call_dtor(ptr %block)
  br label %done
done:
  ret void
}
"""


def allocation() -> str:
    """Return what each object gets a copy of, of which the linker drops what is not called."""
    return _ALLOCATION


def release() -> str:
    """Return what a library holds once: `allocation` and ``asperity_release``."""
    return _ALLOCATION + _RELEASE
