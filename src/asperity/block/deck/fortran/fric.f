      SUBROUTINE FRIC(LM,TAU,DDTDDG,DDTDDP,DSLIP,SED,SFD,
     1 DDTDDT,PNEWDT,STATEV,DGAM,TAULM,PRESS,DPRESS,DDPDDH,SLIP,
     2 KSTEP,KINC,TIME,DTIME,NOEL,CINAME,SLNAME,MSNAME,NPT,NODE,
     3 NPATCH,COORDS,RCOORD,DROT,TEMP,PREDEF,NFDIR,MCRD,NPRED,
     4 NSTATV,CHRLNGTH,PROPS,NPROPS)
C
      INCLUDE 'ABA_PARAM.INC'
C
      CHARACTER*80 CINAME,SLNAME,MSNAME
      DIMENSION TAU(NFDIR),DDTDDG(NFDIR,NFDIR),DDTDDP(NFDIR),
     1 DSLIP(NFDIR),DDTDDT(NFDIR,2),STATEV(*),DGAM(NFDIR),
     2 TAULM(NFDIR),SLIP(NFDIR),TIME(2),COORDS(MCRD),
     3 RCOORD(MCRD),DROT(2,2),TEMP(2),PREDEF(2,*),PROPS(NPROPS)
C
      DIMENSION G(2),S0(2),S(3),D1(2),D2(2),E1(2),E2(2),T(2,2),
     1 AXIS(2)
      LOGICAL ONESID
C
      XMU = PROPS(1)
      SMAX = PROPS(3)
      START = PROPS(5)
      AXIS(1) = 1.D0
      AXIS(2) = PROPS(10)
C
C     Open when the increment began: slide freely to its end. What the
C     asperities had been bent by is gone when they touch again.
      IF (LM.EQ.2) THEN
        STATEV(1) = 0.D0
        STATEV(2) = 0.D0
        STATEV(3) = 0.D0
        RETURN
      END IF
      LM = 0
C
C     Committed deflection, turned with the slip directions, and the
C     slip, both in the frame of the base and over SMAX.
      DO 10 I = 1,2
        S0(I) = AXIS(I)*(DROT(I,1)*STATEV(1)+DROT(I,2)*STATEV(2))/SMAX
        S(I) = S0(I)
        G(I) = 0.D0
        IF (I.LE.NFDIR) G(I) = AXIS(I)*DGAM(I)/SMAX
   10 CONTINUE
      S(3) = STATEV(3)/SMAX
C
C     The base's motion across the drive in this increment is known from
C     the time alone.
      C1 = PROPS(6)*(TIME(2)-START)
      C0 = PROPS(6)*(TIME(2)-DTIME-START)
      DYB = 0.D0
      IF (PROPS(7).NE.0.D0) DYB = PROPS(7)/SMAX*(
     1 ASPWAV(C1,PROPS(8),PROPS(9))-ASPWAV(C0,PROPS(8),PROPS(9)))
      ONESID = TIME(2).LE.START
C
      CALL ASPSLP(G,DYB,PROPS(4),D1,D2,E1,E2)
      CALL ASPLAW(S,D1,D2,E1,E2,PROPS(2),ONESID,T)
C
C     Stress TAU = MU P S/SMAX, and its derivatives.
      P = MAX(PRESS,0.D0)
      STIFF = XMU*P/SMAX
      SED = 0.D0
      SFD = 0.D0
      DO 30 I = 1,MIN(2,NFDIR)
        TAU(I) = XMU*P*AXIS(I)*S(I)
        DDTDDP(I) = XMU*AXIS(I)*S(I)
        DO 20 J = 1,MIN(2,NFDIR)
          DDTDDG(I,J) = STIFF*AXIS(I)*AXIS(J)*T(I,J)
   20   CONTINUE
C       Of the slip, what does not come back; for output.
        DSLIP(I) = DGAM(I)-AXIS(I)*SMAX*(S(I)-S0(I))
        SED = SED+0.5D0*STIFF*(SMAX*S(I))**2
        SFD = SFD+0.5D0*XMU*P*AXIS(I)*(S0(I)+S(I))*DSLIP(I)
   30 CONTINUE
C
      STATEV(1) = AXIS(1)*SMAX*S(1)
      STATEV(2) = AXIS(2)*SMAX*S(2)
      STATEV(3) = SMAX*S(3)
      RETURN
      END
