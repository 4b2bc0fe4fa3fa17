/* Vectors of four numbers, for functions that pyimu/block/vectors.py writes. Each lane does what the
   operation on a number does: a comparison gives 1 or 0, and a choice keeps all bits of what it takes. */

#include <math.h>
#include <stdint.h>

typedef double Vector2 __attribute__((vector_size(16)));
typedef double Vector4 __attribute__((vector_size(32)));
typedef int64_t Mask4 __attribute__((vector_size(32)));
typedef double Vector2At __attribute__((vector_size(16), aligned(8), may_alias));
typedef double Vector4At __attribute__((vector_size(32), aligned(8), may_alias));

#define VECTOR4_AT(p) (*(const Vector4At *) (p))
#define STORE4(p, a) (*(Vector4At *) (p) = (a))
#define STORE3(p, a) (*(Vector2At *) (p) = (Vector2){(a)[0], (a)[1]}, (p)[2] = (a)[2])

#define EVERY4(x) ((Vector4){x, x, x, x})
#define SIGN4 ((Mask4) EVERY4(-0.0))
#define WHERE4(mask, x) ((Vector4) ((Mask4) (x) & (Mask4) (mask)))
#define CHOICE4(mask, x, y) ((Vector4) (((Mask4) (x) & (mask)) | ((Mask4) (y) & ~(mask))))

#define LESS4(x, y) WHERE4((x) < (y), EVERY4(1.0))
#define AT_MOST4(x, y) WHERE4((x) <= (y), EVERY4(1.0))
#define EQUAL4(x, y) WHERE4((x) == (y), EVERY4(1.0))
#define NOT4(x) EQUAL4(x, EVERY4(0.0))
#define IF4(x, y) WHERE4((x) != EVERY4(0.0), y)
#define FMAX4(x, y) CHOICE4((Mask4) ((x) >= (y)) | (Mask4) ((y) != (y)), x, y)
#define FMIN4(x, y) CHOICE4((Mask4) ((x) <= (y)) | (Mask4) ((y) != (y)), x, y)
#define FABS4(x) ((Vector4) ((Mask4) (x) & ~SIGN4))
#define COPYSIGN4(x, y) CHOICE4(SIGN4, y, x)

/* A root has no operator; one of a vector takes little more than one of a number. */
#if defined(__has_builtin)
#if __has_builtin(__builtin_ia32_sqrtpd256)
#define SQRT4(x) ((Vector4) __builtin_ia32_sqrtpd256(x))
#endif
#endif
#ifndef SQRT4
#define SQRT4(x) ((Vector4){sqrt((x)[0]), sqrt((x)[1]), sqrt((x)[2]), sqrt((x)[3])})
#endif
