C
      SUBROUTINE ASPLAW(S,D1,D2,E1,E2,XI,ONESID,T)
C     Dahl's law in two explicit phases, everything over SMAX.
C     S(1), S(2): deflection, changed from start to end of increment;
C     S(3): its size, with a sign (a slip backwards may turn it).
C     D1, D2: slip of the phases; E1, E2: their derivatives by the slip.
C     ONESID: the direction is forced to the drive axis.
C     T(I,J): derivative of S(I) by the slip along axis J.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION S(3),D1(2),D2(2),E1(2),E2(2),T(2,2),U1(2),U2(2)
      LOGICAL ONESID
C
      CALL ASPPHA(S(1)+D1(1),S(2)+D1(2),ONESID,R,RX,RY,CA,SA,FREEA)
      CALL ASPALG(S(3),R,XI,SM,SMR,SMS)
      CALL ASPPHA(SM*CA+D2(1),SM*SA+D2(2),ONESID,Q,QX,QY,CB,SB,FREEB)
      CALL ASPALG(SM,Q,XI,SL,SLQ,SLS)
C
      DO 10 J = 1,2
        U1(1) = 0.D0
        U1(2) = 0.D0
        U2(1) = 0.D0
        U2(2) = 0.D0
        U1(J) = E1(J)
        U2(J) = E2(J)
C       Phase 1: reach, size, direction.
        DR = RX*U1(1)+RY*U1(2)
        DSM = SMR*DR
        DCA = FREEA*(U1(1)-CA*DR)
        DSA = FREEA*(U1(2)-SA*DR)
C       Phase 2.
        DQX = DSM*CA+SM*DCA+U2(1)
        DQY = DSM*SA+SM*DSA+U2(2)
        DQ = QX*DQX+QY*DQY
        DSL = SLQ*DQ+SLS*DSM
        T(1,J) = DSL*CB+SL*FREEB*(DQX-CB*DQ)
        T(2,J) = DSL*SB+SL*FREEB*(DQY-SB*DQ)
   10 CONTINUE
      S(1) = SL*CB
      S(2) = SL*SB
      S(3) = SL
      RETURN
      END
C
      SUBROUTINE ASPPHA(X,Y,ONESID,R,RX,RY,C,S,FREE)
C     Length and unit vector of the way from the root of the asperity to
C     its tip; the direction it takes; 1/length where that can turn.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      LOGICAL ONESID
      R = SQRT(X*X+Y*Y)
      RX = 0.D0
      RY = 0.D0
      C = 1.D0
      S = 0.D0
      FREE = 0.D0
      IF (R.LE.0.D0) RETURN
      RX = X/R
      RY = Y/R
      IF (ONESID) RETURN
      C = RX
      S = RY
      FREE = 1.D0/R
      RETURN
      END
C
      SUBROUTINE ASPALG(SIZE,REACH,XI,END,ENDR,ENDS)
C     Size of the deflection after its tip moved from SIZE to REACH, by
C     Dahl's explicit step; its derivatives by REACH and by SIZE.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      WAY = REACH-SIZE
      SGN = SIGN(1.D0,WAY)
      REST = 1.D0-SIZE*SGN
      IF (XI.EQ.1.D0) THEN
        ENDR = REST
        SLOPE = 1.D0
      ELSE
C       Beyond the limit a power of a negative number has no value.
        REST = MAX(REST,0.D0)
        ENDR = REST**XI
        SLOPE = 0.D0
        IF (REST.GT.0.D0) SLOPE = XI*REST**(XI-1.D0)
      END IF
      END = SIZE+WAY*ENDR
      ENDS = 1.D0-ENDR-WAY*SLOPE*SGN
      RETURN
      END
